#include "bench/worlds/learn/contacts.h"

#include <fmt/format.h>

#include <cmath>

#include "cli/gap/gap_recordings.h"
#include "core/error.h"
#include "core/progress.h"
#include "gap/evidence/model.h"
#include "gap/replay/run_groups.h"
#include "gap/trial/write/answers.h"

namespace umbsim::worlds {
namespace {

constexpr double kOpen = 10;  // times what is believed
constexpr std::size_t kArcLegs = gap::kContactDifferences, kCreepAcross = kArcLegs + 1;

// Which figure a column of a group of runs is.
std::size_t figure_of(gap::ContactDifference d, bool rolling) {
  return d == gap::kLegScale && rolling ? kArcLegs : std::size_t(d);
}

void look_at_contacts(const std::string& recording, ContactsOfEngine& found,
                      std::array<double, kContactFigures>& believed) {
  const GapRecordings recordings({recording}, "");
  const gap::Model model(recordings.campaign(), recordings.simulator(true), gap::Scatter{});
  if (!model.engine_is_open()) return;
  const gap::Fit none = model.none();
  const Eigen::VectorXd sd = model.nuisance_sds().front();
  const gap::RunGroups groups = gap::grouped(model.recording().runs, model.nominal().origin);
  Eigen::VectorXd open = sd;
  for (Eigen::Index i = 0; i < open.size(); ++i) {
    if (model.engine_sd()[i] > 0) open[i] *= kOpen;
  }
  // A lead that is alike everywhere is the tracker's clock.
  for (std::size_t g = 0; g < groups.rolling.size(); ++g) {
    for (const auto lead : {gap::kLeadAlong, gap::kLeadTurning})
      open[gap::column_of(g, lead)] = sd[gap::column_of(g, lead)];
  }
  const gap::Evidence e = gap::evidence(none.grams, model.all_runs(), gap::first_columns(model.nuisances()), open);
  const auto keep = [&](std::size_t figure, Eigen::Index column) {
    believed[figure] = sd[column];
    if (std::sqrt(e.covariance(column, column)) < sd[column]) found[figure].push_back(e.mean[column]);
  };
  for (std::size_t g = 0; g < groups.rolling.size(); ++g) {
    for (int i = 0; i < int(gap::kContactDifferences); ++i) {
      const auto d = gap::ContactDifference(i);
      // Only the moments at which a turn in place begins and ends roll in an arc.
      if (d == gap::kArcScale && !groups.rolling[g]) continue;
      keep(figure_of(d, groups.rolling[g]), gap::column_of(g, d));
    }
  }
  keep(kCreepAcross, gap::kCreepColumn);
}

}  // namespace

const std::array<ContactFigure, kContactFigures> kContactFigure{
    {{"distance, between turns in place", "%", 0.01, 3},
     {"turns in place", "%", 0.01, 3},
     {"rolling turns", "%", 0.01, 3},
     {"heading on legs", "mrad/m", 1e-3, 3},
     {"sideways on legs", "mm/m", 1e-3, 3},
     {"lead along", "ms", 1e-3, 1},
     {"lead of turns", "ms", 1e-3, 1},
     {"lead along, more per m/s", "ms", 1e-3, 1},
     {"lead of turns, more per rad/s", "ms", 1e-3, 1},
     {"outward in turns in place, at 1 rad/s", "mm/s", 1e-3, 3},
     {"distance, between rolling turns", "%", 0.01, 3},
     {"creep across", "per traction ratio", 1, 3}}};

ContactsFound contacts_found(const TrialFolder& folder) {
  ContactsFound all;
  const Json answers = read_json(folder.answers());
  std::vector<std::pair<std::string, std::string>> cases;  // name, engine
  for (const auto& [name, answer] : read_answers(folder.answers())) {
    if (answer.tier != Tier::no_effect) continue;
    const Json& said = answers.at("cases").at(name);
    if (!said.contains("world"))
      throw InputError(
          fmt::format("{}: case {} does not say in which world it was drawn", folder.answers().string(), name));
    cases.emplace_back(name, said.at("world").at("engine"));
  }
  Progress progress("how contacts differ", int(cases.size()));
  for (const auto& [name, engine] : cases) {
    try {
      look_at_contacts((folder.recordings() / name).string(), all.by_engine[engine], all.believed);
    } catch (const InputError&) {
      ++all.refused;
    }
    progress.step();
  }
  return all;
}

}  // namespace umbsim::worlds
