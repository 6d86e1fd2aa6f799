#include <fmt/format.h>

#include "bench/worlds/score/score.h"

namespace umbsim::worlds {
namespace {

struct Column {
  const char* key;
  const char* head;
  Figure WorldFigures::*figure;
  bool by_group;  // in the tables of groups, too
};

constexpr Column kColumns[] = {
    {"false_alarm", "false alarm", &WorldFigures::false_alarm, true},
    {"pose_alarm", "the same, for the poses", &WorldFigures::pose_alarm, false},
    {"quiet_alarm", "the same, in quiet worlds", &WorldFigures::quiet_alarm, false},
    {"right", "first cause right", &WorldFigures::right, true},
    {"plain", "the same, plainly there", &WorldFigures::plain, true},
    {"both", "both of two named, and nothing else", &WorldFigures::both, true},
    {"named", "truth among the named", &WorldFigures::named, true},
    {"in_set", "truth in the set", &WorldFigures::in_set, true},
    {"only_true", "some truth named, nothing untrue", &WorldFigures::only_true, false},
    {"not_there", "named, not there, > 0.5 floors", &WorldFigures::not_there, true},
    {"untrue", "named, not there", &WorldFigures::untrue, false},
    {"closure", "closure on held-out runs, median", &WorldFigures::closure, false},
    {"closed", "closure >= 0.7", &WorldFigures::closed, true},
    {"misled", "closure below 0", &WorldFigures::misled, false},
    {"covered", "95 % intervals that hold the truth", &WorldFigures::covered, false},
    {"calibration", "calibration error of stated probabilities", &WorldFigures::calibration, false},
    {"unknown_recall", "unknown found at 5 % known rejected", &WorldFigures::unknown_recall, false},
    {"unknown_area", "area under that curve", &WorldFigures::unknown_area, false},
    {"wall_s", "s a diagnosis", &WorldFigures::wall_s, true},
    {"longest_s", "s, the longest", &WorldFigures::longest_s, false},
};

std::string cell(const Figure& f) {
  if (f.cases == 0) return "–";
  const Estimate& e = f.estimate;
  if (f.unit == "share")
    return fmt::format("{:.0f} % [{:.0f}, {:.0f}] of {}", 100 * e.value, 100 * e.low, 100 * e.high, f.cases);
  if (e.low == e.high) return fmt::format("{:.2f}", e.value);
  return fmt::format("{:.2f} [{:.2f}, {:.2f}]", e.value, e.low, e.high);
}

Json figure_json(const Figure& f) {
  if (f.cases == 0) return {{"cases", 0}};
  Json json{{"value", f.estimate.value}, {"ci95", {f.estimate.low, f.estimate.high}}, {"cases", f.cases}};
  if (f.unit == "share") json["hits"] = f.hits;
  return json;
}

Json figures_json(const WorldFigures& f) {
  Json json{{"cases", f.cases}, {"undetectable", f.undetectable}, {"failed", f.failed}};
  for (const Column& c : kColumns) json[c.key] = figure_json(f.*c.figure);
  return json;
}

// The detection and the calibration curve of an engine's cases, or of all.
Json curves_of(const WorldScore& score, const std::string& engine) {
  std::vector<Verdict> verdicts;
  for (const WorldVerdict& w : score.verdicts) {
    if (engine.empty() || w.groups.at("engine") == engine) verdicts.push_back(w.verdict);
  }
  return curves_json(verdicts);
}

std::string row(const std::string& which, const WorldFigures& f) {
  std::string text = fmt::format("| {} | {} |", which, f.cases);
  for (const Column& c : kColumns) {
    if (c.by_group) text += fmt::format(" {} |", cell(f.*c.figure));
  }
  return text + "\n";
}

std::string head(const std::string& by) {
  std::string text = fmt::format("| {} | cases |", by), line = "|---|---|";
  for (const Column& c : kColumns) {
    if (!c.by_group) continue;
    text += fmt::format(" {} |", c.head);
    line += "---|";
  }
  return text + "\n" + line + "\n";
}

Json verdict_json(const WorldVerdict& w) {
  const Verdict& v = w.verdict;
  Json json{
      {"kind", w.kind},         {"truth", v.truth},       {"named", v.named},     {"probability", v.probability},
      {"detected", v.detected}, {"right", v.right},       {"unknown", w.unknown}, {"not_there_floors", w.not_there},
      {"wall_s", v.wall_s},     {"engine_steps", w.steps}};
  if (const auto severity = v.answer.severity()) json["severity"] = *severity;
  json["undetectable_expected"] = v.answer.undetectable_expected;
  if (v.diagnosis.closure) json["closure"] = *v.diagnosis.closure;
  for (const auto& [by, which] : w.groups) json[by] = which;
  return json;
}

}  // namespace

Json score_json(const WorldScore& score) {
  Json json{{"format", "umbsim-worlds-score/1"},      {"name", score.name},
            {"answers_sha256", score.answers_sha256}, {"sealed", score.sealed},
            {"not_diagnosed", score.not_diagnosed},   {"worlds_redrawn", score.worlds_redrawn}};
  json["all"] = figures_json(score.all);
  json["all"].update(curves_of(score, ""));
  for (const auto& [by, groups] : score.groups) {
    for (const auto& [which, f] : groups) json["by"][by][which] = figures_json(f);
  }
  for (auto& [engine, figures] : json["by"]["engine"].items()) figures.update(curves_of(score, engine));
  const LeakFigure& l = score.leak;
  json["leak"] = {{"cases", l.cases}, {"accuracy", l.accuracy}, {"chance", l.chance}, {"p_value", l.p_value}};
  for (const WorldVerdict& w : score.verdicts) json["verdicts"][w.verdict.name] = verdict_json(w);
  return json;
}

std::string score_markdown(const WorldScore& score) {
  std::string text = fmt::format(
      "# Worlds {}\n\nAnswers {} ({}). {} cases diagnosed, {} not yet; {} of them failed; the "
      "effects of {} cannot show. To draw them, {} worlds more were drawn whose nominal robot "
      "does not drive.\n",
      score.name, score.answers_sha256.substr(0, 12), score.sealed ? "sealed" : "not sealed", score.all.cases,
      score.not_diagnosed, score.all.failed, score.all.undetectable, score.worlds_redrawn);
  text += fmt::format("\n| figure | {} cases |\n|---|---|\n", score.all.cases);
  for (const Column& c : kColumns) text += fmt::format("| {} | {} |\n", c.head, cell(score.all.*c.figure));
  for (const char* by : {"engine", "runs", "tracker", "driver", "robot", "effect"}) {
    const auto groups = score.groups.find(by);
    if (groups == score.groups.end()) continue;
    text += fmt::format("\n{}", head(by));
    for (const auto& [which, f] : groups->second) text += row(which, f);
  }
  const LeakFigure& l = score.leak;
  return text + fmt::format(
                    "\nLeak test: effects guessed from sizes and names of files {:.1f} %, by chance {:.1f} % (p = "
                    "{:.2f}, {} cases).\n",
                    100 * l.accuracy, 100 * l.chance, l.p_value, l.cases);
}

}  // namespace umbsim::worlds
