// How contacts differ from this simulator's, measured from worlds with nothing wrong.
#include "bench/worlds/learn/contacts.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "bench/worlds/draw/draw.h"
#include "core/text/text_file.h"
#include "gap/noise/nuisances.h"

namespace umbsim::worlds {
namespace {

// Wheels of the planar model roll as they do here: turns and distances agree to what it and its floor are known by.
TEST(Contacts, OfAVehicleModelOfThePlaneAreOurs) {
  const ScratchFolder scratch;
  write_text_file(scratch.path() / "worlds.yaml",
                  "format: umbsim-worlds/1\nname: contacts\nseed: 9\nengines: [planar]\nruns: [recommended]\n"
                  "drivers: [own]\ntrackers: [mocap]\ncases_per_engine: {none: 1}\n");
  const TrialFolder folder(scratch.path() / "worlds");
  draw_worlds(read_worlds((scratch.path() / "worlds.yaml").string()), folder, {0, 1}, 2);
  const ContactsFound all = contacts_found(folder);
  EXPECT_EQ(all.refused, 0);
  ASSERT_EQ(all.by_engine.size(), 1u);
  const ContactsOfEngine& found = all.by_engine.at("planar");
  for (std::size_t f = 0; f < kContactFigures; ++f) {
    const ContactFigure& figure = kContactFigure[f];
    ASSERT_GT(all.believed[f], 0) << figure.name;
    std::printf("%s, believed %.3f %s:", figure.name, all.believed[f] / figure.per_unit, figure.unit);
    for (const double value : found[f]) std::printf(" %.3f", value / figure.per_unit);
    std::printf("\n");
    for (const double value : found[f]) EXPECT_LT(std::abs(value), 3 * all.believed[f]) << figure.name;
  }
  for (const double turns : found[gap::kTurnScale]) EXPECT_LT(std::abs(turns), 5e-4);
  EXPECT_EQ(found[gap::kTurnScale].size(), 3u) << "groups of runs that turn in place: as usual, fast, loaded";
}

}  // namespace
}  // namespace umbsim::worlds
