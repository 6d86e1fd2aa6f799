#include "bench/worlds/learn/case_shares.h"

#include <fmt/format.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include <atomic>
#include <set>

#include "cli/gap/gap_recordings.h"
#include "core/error.h"
#include "core/first_failure.h"
#include "core/progress.h"
#include "effects/catalogue.h"
#include "gap/search/search.h"
#include "gap/traits/traits.h"

namespace umbsim::worlds {
namespace {

namespace fs = std::filesystem;

std::set<std::string> all_but(const std::string& effect) {
  std::set<std::string> others;
  for (const EffectInfo& info : catalogue()) {
    if (info.name != effect) others.insert(info.name);
  }
  return others;
}

fs::path shares_file(const TrialFolder& folder, const std::string& name) {
  return folder.root / "shares" / (name + ".json");
}

Json numbers(const Eigen::MatrixXd& m) { return std::vector<double>(m.data(), m.data() + m.size()); }

// What follows from rolling alone is the same in every engine.
bool only_rolls(const std::string& effect) {
  return gap::is_dimension(effect) || effect == "wear" || effect == "carpet_drift";
}

// What is wrong in a case, and in which engine: only cases of one effect that the diagnosis knows.
struct Known {
  std::string name, effect, engine;
};

std::vector<Known> known_cases(const TrialFolder& folder) {
  std::vector<Known> known;
  const Json answers = read_json(folder.answers());
  for (const auto& [name, answer] : read_answers(folder.answers())) {
    if (answer.tier != Tier::single || answer.effects.size() != 1 || only_rolls(answer.effects.begin()->first))
      continue;
    const Json& said = answers.at("cases").at(name);
    if (!said.contains("world"))
      throw InputError(
          fmt::format("{}: case {} does not say in which world it was drawn; only folders of "
                      "`umbsim_worlds draw` teach anything",
                      folder.answers().string(), name));
    known.push_back({name, answer.effects.begin()->first, said.at("world").at("engine")});
  }
  return known;
}

CaseShares look_at_case(const TrialFolder& folder, const Known& c) {
  CaseShares found{c.name, c.effect, c.engine, {}};
  const GapRecordings recordings({(folder.recordings() / c.name).string()}, "");
  gap::Model model(recordings.campaign(), recordings.simulator(true), gap::Scatter{});
  if (c.engine != "ours" && model.engine_is_open()) model.take_for_another_engines();
  gap::Screen screen(model, all_but(c.effect));
  gap::Thresholds alone;
  alone.most_effects = 1;
  alone.smallest = alone.least_seen = 0;
  const gap::Found fits = gap::search(model, screen, alone, [](const std::string&, double) {});
  const gap::Fit* best = nullptr;
  for (const gap::Fit& fit : fits.fits) {
    if (fit.hypotheses.size() == 1 && (!best || fit.log_evidence > best->log_evidence)) best = &fit;
  }
  if (!best) return found;
  for (const double motion : kMotions) found.by_motion.push_back(gap::signature_shares(model, *best, motion));
  return found;
}

}  // namespace

Json shares_json(const CaseShares& shares) {
  Json json{{"case", shares.name}, {"effect", shares.effect}, {"engine", shares.engine}, {"motions", Json::array()}};
  for (const gap::SignatureShares& s : shares.by_motion) {
    json["motions"].push_back({{"log_density", s.log_density},
                               {"part", s.part},
                               {"pull", numbers(s.pull)},
                               {"precision", numbers(s.precision)}});
  }
  return json;
}

CaseShares read_shares(const Json& json) {
  CaseShares shares{json.at("case"), json.at("effect"), json.at("engine"), {}};
  for (const Json& m : json.at("motions")) {
    gap::SignatureShares s;
    s.log_density = m.at("log_density");
    s.part = m.at("part").get<std::vector<std::size_t>>();
    const auto pull = m.at("pull").get<std::vector<double>>();
    const auto precision = m.at("precision").get<std::vector<double>>();
    const Eigen::Index n = Eigen::Index(pull.size());
    s.pull = Eigen::Map<const Eigen::VectorXd>(pull.data(), n);
    s.precision = Eigen::Map<const Eigen::MatrixXd>(precision.data(), n, n);
    shares.by_motion.push_back(std::move(s));
  }
  return shares;
}

SharesFound look_at_cases(const TrialFolder& folder, int jobs) {
  std::optional<tbb::global_control> limit;
  if (jobs > 0) limit.emplace(tbb::global_control::max_allowed_parallelism, std::size_t(jobs));
  const std::vector<Known> known = known_cases(folder);
  std::vector<std::size_t> open;
  for (std::size_t i = 0; i < known.size(); ++i) {
    if (!fs::exists(shares_file(folder, known[i].name))) open.push_back(i);
  }
  std::atomic<int> refused = 0;
  FirstFailure failure;
  Progress progress("looking at signatures", int(open.size()));
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, open.size(), 1),
      [&](const auto& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
          const Known& c = known[open[i]];
          failure.attempt(i, [&] {
            try {
              write_file_whole(shares_file(folder, c.name), shares_json(look_at_case(folder, c)).dump());
            } catch (const InputError&) {
              ++refused;
            }
            progress.step();
          });
        }
      },
      tbb::simple_partitioner());
  failure.rethrow();
  SharesFound all{{}, refused};
  for (const Known& c : known) {
    const fs::path file = shares_file(folder, c.name);
    if (fs::exists(file)) all.cases.push_back(read_shares(read_json(file)));
  }
  return all;
}

}  // namespace umbsim::worlds
