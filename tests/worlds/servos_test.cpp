// How counts follow their commands, measured from worlds whose servos are known.
#include "bench/worlds/learn/servos.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

#include "bench/worlds/draw/draw.h"
#include "core/text/text_file.h"
#include "gap/trial/write/answers.h"

namespace umbsim::worlds {
namespace {

constexpr double kOfALag_s = 0.008;  // integral action and the speed of the rotor shift it by some milliseconds

// A servo of first order lags by its time constant, behind what its motor lags.
TEST(ServoResponses, LagByWhatTheWorldsSay) {
  const ScratchFolder scratch;
  write_text_file(scratch.path() / "worlds.yaml",
                  "format: umbsim-worlds/1\nname: servos\nseed: 8\nengines: [planar]\nruns: [one_way]\n"
                  "drivers: [own]\ntrackers: [mocap]\ncases_per_engine: {none: 3}\n");
  const TrialFolder folder(scratch.path() / "worlds");
  draw_worlds(read_worlds((scratch.path() / "worlds.yaml").string()), folder, {0, 1}, 2);
  std::vector<double> known;
  const Json answers = read_json(folder.answers());
  for (const Json& answer : answers.at("cases")) {
    const Json& world = answer.at("world");
    known.push_back(world.at("motor_lag_s").get<double>() + world.at("options").at("servo_time_s").get<double>());
  }
  const ServoResponses found = servo_responses(folder);
  EXPECT_EQ(found.refused, 0);
  ASSERT_EQ(found.by_engine.size(), 1u);
  std::vector<double> lags;
  for (const ServoResponse& response : found.by_engine.at("planar")) {
    lags.push_back(response[kServoLag]);
    EXPECT_LT(response.head(2).cwiseAbs().maxCoeff(), 0.002) << "these servos hold their speed";
  }
  ASSERT_EQ(lags.size(), known.size());
  std::sort(known.begin(), known.end());
  std::sort(lags.begin(), lags.end());
  for (std::size_t i = 0; i < lags.size(); ++i) {
    std::printf("lag %.1f ms, of motor and servo %.1f ms\n", 1000 * lags[i], 1000 * known[i]);
    EXPECT_NEAR(lags[i], known[i], kOfALag_s);
  }
}

}  // namespace
}  // namespace umbsim::worlds
