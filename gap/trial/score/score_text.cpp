// What a score is written as: JSON, tables, CSV, a picture.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "gap/trial/score/score.h"

namespace umbsim {
namespace {

Json estimate_json(const Estimate& e) { return {{"value", e.value}, {"ci95", {e.low, e.high}}}; }

Json figure_json(const Figure& f) {
  Json json{{"text", f.text}, {"unit", f.unit}, {"cases", f.cases}};
  if (f.unit == "share") json["hits"] = f.hits;
  if (f.cases > 0) json.update(estimate_json(f.estimate));
  if (!f.bar.empty()) json["bar"] = f.bar;
  if (f.met != Figure::Met::no_bar) json["met"] = name(f.met);
  return json;
}

Json tally_json(const Tally& t) {
  return {{"cases", t.cases},
          {"right", t.right},
          {"right_or_tied", t.right_or_tied},
          {"in_set", t.in_set},
          {"detected", t.detected},
          {"called_unknown", t.unknown},
          {"right_share", estimate_json(share(t.right, t.cases))},
          {"detected_share", estimate_json(share(t.detected, t.cases))}};
}

Json leak_json(const LeakFigure& l) {
  return {{"cases", l.cases}, {"accuracy", l.accuracy}, {"chance", l.chance}, {"p_value", l.p_value}};
}

Json baseline_json(const Baseline& b) {
  Json json{{"text", b.text}};
  if (!b.note.empty()) {
    json["note"] = b.note;
    return json;
  }
  json["first_cause_right"] = estimate_json(share(b.right, b.cases));
  json["cases"] = b.cases;
  json["false_alarm"] = estimate_json(share(b.false_alarms, b.no_effect_cases));
  json["no_effect_cases"] = b.no_effect_cases;
  return json;
}

Json effects_json(const Answer& answer) {
  Json json = Json::object();
  for (const auto& [effect, truth] : answer.effects) {
    json[effect] = Json::object();
    for (const auto& [parameter, value] : truth.parameters) json[effect][parameter] = value;
    if (!truth.run.empty()) json[effect]["run"] = truth.run;
  }
  return json;
}

Json verdict_json(const Verdict& v) {
  const std::optional<double> severity = v.answer.severity();
  Json json{{"name", v.name},
            {"tier", name(v.answer.tier)},
            {"effects", effects_json(v.answer)},
            {"severity", severity ? Json(*severity) : Json()},
            {"undetectable_expected", v.answer.undetectable_expected},
            {"named", v.named},
            {"probability", v.probability},
            {"right", v.right},
            {"right_or_tied", v.right_or_tied},
            {"in_set", v.in_set},
            {"wall_s", v.wall_s}};
  Json set = Json::array();
  for (const EffectNames& member : v.diagnosis.set) set.push_back(joined(member));
  json["set"] = set;
  if (v.stage_right) json["stage_right"] = *v.stage_right;
  if (v.location_right) json["location_right"] = *v.location_right;
  for (const ParameterVerdict& p : v.parameters) {
    json["parameters"][p.effect][p.parameter] = {
        {"truth", p.truth}, {"found", p.found}, {"relative_error", p.relative_error}, {"covered", p.covered}};
  }
  return json;
}

std::string value_text(const Figure& f) {
  if (f.cases == 0) return "-";
  if (f.unit == "share") return fmt::format("{:.1f} %", 100 * f.estimate.value);
  if (f.key == "parameter_error") return fmt::format("{:.1f} %", 100 * f.estimate.value);
  return fmt::format("{:.3g}{}", f.estimate.value, f.unit == "s" ? " s" : "");
}

std::string interval_text(const Figure& f) {
  if (f.cases == 0) return "";
  const double scale = f.unit == "share" || f.key == "parameter_error" ? 100 : 1;
  return fmt::format("{:.3g} to {:.3g}", scale * f.estimate.low, scale * f.estimate.high);
}

std::string count_text(const Figure& f) {
  return f.unit == "share" ? fmt::format("{} of {}", f.hits, f.cases) : fmt::format("{}", f.cases);
}

std::string percent(int k, int n) { return n == 0 ? "-" : fmt::format("{:.0f} %", 100.0 * k / n); }

std::string tally_line(const std::string& label, const Tally& t) {
  return fmt::format("  {:<26}{:>6}{:>8}{:>9}{:>8}{:>10}{:>9}\n", label, t.cases, percent(t.right, t.cases),
                     percent(t.right_or_tied, t.cases), percent(t.in_set, t.cases), percent(t.detected, t.cases),
                     percent(t.unknown, t.cases));
}

std::string tally_header(const char* title) {
  return fmt::format("{:<28}{:>6}{:>8}{:>9}{:>8}{:>10}{:>9}\n", title, "cases", "right", "or tied", "in set",
                     "detected", "unknown");
}

std::string severity_label(const SeverityBin& bin) {
  return std::isinf(bin.to) ? fmt::format("{} and above", bin.from) : fmt::format("{} to {}", bin.from, bin.to);
}

std::string baseline_text(const Baseline& b) {
  if (!b.note.empty()) return b.note;
  return fmt::format("right in {} of {}, false alarms {} of {}", b.right, b.cases, b.false_alarms, b.no_effect_cases);
}

std::string leak_text(const char* label, const LeakFigure& l) {
  return fmt::format("  {:<58}{:>7.1f} %, chance {:.1f} %, p = {:.3f}, {} cases\n", label, 100 * l.accuracy,
                     100 * l.chance, l.p_value, l.cases);
}

int count(const Confusion& c, const std::string& row, const std::string& column) {
  const auto found = c.counts.find({row, column});
  return found == c.counts.end() ? 0 : found->second;
}

int row_total(const Confusion& c, const std::string& row) {
  int total = 0;
  for (const std::string& column : c.columns) total += count(c, row, column);
  return total;
}

}  // namespace

Json curves_json(const std::vector<Verdict>& verdicts) {
  Json json;
  json["by_severity"] = Json::array();
  for (const SeverityBin& bin : by_severity(verdicts)) {
    Json entry{{"from", bin.from}, {"to", std::isinf(bin.to) ? Json() : Json(bin.to)}};
    entry.update(tally_json(bin.tally));
    json["by_severity"].push_back(entry);
  }
  json["calibration"] = Json::array();
  for (const CalibrationBin& bin : calibration_curve(verdicts)) {
    json["calibration"].push_back({{"from", bin.from}, {"to", bin.to}, {"cases", bin.cases},
                                   {"mean_probability", bin.mean_probability},
                                   {"right_share", estimate_json(share(bin.right, bin.cases))}});
  }
  return json;
}

Json score_json(const TrialScore& s) {
  Json json{{"format", "umbsim-trial-score/1"}, {"trial", s.trial}, {"cases", s.verdicts.size()},
            {"answers_sha256", s.answers_sha256}, {"sealed_before_diagnosis", s.sealed}};
  for (const Figure& f : s.figures) json["figures"][f.key] = figure_json(f);
  for (const Baseline& b : s.baselines) json["baselines"][b.key] = baseline_json(b);
  for (const auto& [tier, tally] : by_tier(s.verdicts)) json["by_tier"][tier] = tally_json(tally);
  for (const auto& [effect, tally] : by_effect(s.verdicts)) json["by_effect"][effect] = tally_json(tally);
  json.update(curves_json(s.verdicts));
  json["leaks"]["shuffled_labels"] = leak_json(s.shuffled);
  if (s.metadata) json["leaks"]["metadata"] = leak_json(*s.metadata);
  json["verdicts"] = Json::array();
  for (const Verdict& v : s.verdicts) json["verdicts"].push_back(verdict_json(v));
  return json;
}

std::string confusion_csv(const Confusion& c) {
  std::string text = "truth";
  for (const std::string& column : c.columns) text += "," + column;
  text += "\n";
  for (const std::string& row : c.rows) {
    text += row;
    for (const std::string& column : c.columns) text += fmt::format(",{}", count(c, row, column));
    text += "\n";
  }
  return text;
}

std::string confusion_svg(const Confusion& c, const std::string& title) {
  constexpr int kCell = 22, kLeft = 190, kTop = 190, kMargin = 20;
  const int width = kLeft + kCell * int(c.columns.size()) + kMargin;
  const int height = kTop + kCell * int(c.rows.size()) + kMargin;
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\" "
      "font-family=\"sans-serif\" font-size=\"11\">\n<rect width=\"{0}\" height=\"{1}\" fill=\"white\"/>\n"
      "<text x=\"{2}\" y=\"20\" font-size=\"14\">{3}</text>\n<text x=\"{2}\" y=\"36\">rows: truth, columns: first "
      "cause "
      "named</text>\n",
      width, height, kMargin, title);
  for (std::size_t k = 0; k < c.columns.size(); ++k) {
    const int x = kLeft + kCell * int(k) + kCell / 2 + 4;
    svg += fmt::format("<text transform=\"translate({},{}) rotate(-90)\">{}</text>\n", x, kTop - 6, c.columns[k]);
  }
  for (std::size_t i = 0; i < c.rows.size(); ++i) {
    const int y = kTop + kCell * int(i), total = row_total(c, c.rows[i]);
    svg += fmt::format("<text x=\"{}\" y=\"{}\" text-anchor=\"end\">{}</text>\n", kLeft - 6, y + 15, c.rows[i]);
    for (std::size_t k = 0; k < c.columns.size(); ++k) {
      const int n = count(c, c.rows[i], c.columns[k]), x = kLeft + kCell * int(k);
      const double share_of_row = total == 0 ? 0 : double(n) / total;
      svg += fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"#1f5fa8\" fill-opacity=\"{:.3f}\" "
                         "stroke=\"#cccccc\"/>\n", x, y, kCell, kCell, share_of_row);
      if (n == 0) continue;
      svg += fmt::format("<text x=\"{}\" y=\"{}\" text-anchor=\"middle\" fill=\"{}\">{}</text>\n", x + kCell / 2,
                         y + 15, share_of_row > 0.5 ? "white" : "black", n);
    }
  }
  return svg + "</svg>\n";
}

std::string undetected_table(const TrialScore& s) {
  std::string text;
  for (const Verdict& v : s.verdicts) {
    if (!v.answer.undetectable_expected) continue;
    text += fmt::format("  {}  {:<12} {:<28} severity {:.2g}, named {}\n", v.name, name(v.answer.tier), v.truth,
                        v.answer.severity().value_or(0), v.named);
  }
  return text;
}

std::string score_table(const TrialScore& s) {
  std::string text = fmt::format("Trial {}: {} cases, answers {} {}\n", s.trial, s.verdicts.size(),
                                 s.sealed ? "sealed before the diagnoses:" : "NOT SEALED, SHA-256", s.answers_sha256);
  text += fmt::format("  {:<58}{:>10}{:>18}{:>12}  {}\n", "figure", "", "95 % interval", "cases", "bar");
  for (const Figure& f : s.figures) {
    text += fmt::format("  {:<58}{:>10}{:>18}{:>12}  {}{}\n", f.text, value_text(f), interval_text(f), count_text(f),
                        f.bar, f.met == Figure::Met::no_bar ? "" : fmt::format(": {}", name(f.met)));
  }
  text += "Baselines\n";
  for (const Baseline& b : s.baselines) text += fmt::format("  {:<58}{}\n", b.text, baseline_text(b));
  text += "Leaks\n" + leak_text("shuffled answers (accuracy: with the true ones)", s.shuffled);
  if (s.metadata) text += leak_text("guessed from sizes, row counts, names and times", *s.metadata);
  text += tally_header("Tier");
  for (const auto& [tier, tally] : by_tier(s.verdicts)) text += tally_line(tier, tally);
  text += tally_header("Severity, noise floors");
  for (const SeverityBin& bin : by_severity(s.verdicts)) {
    if (bin.tally.cases > 0) text += tally_line(severity_label(bin), bin.tally);
  }
  text += tally_header("Effect");
  for (const auto& [effect, tally] : by_effect(s.verdicts)) text += tally_line(effect, tally);
  const std::string undetected = undetected_table(s);
  if (!undetected.empty()) text += "No plausible strength shows above the noise\n" + undetected;
  return text;
}

std::string score_markdown(const TrialScore& s) {
  std::string text = fmt::format("Trial `{}`, {} cases. SHA-256 of the answers: `{}`{}.\n\n", s.trial,
                                 s.verdicts.size(), s.answers_sha256, s.sealed ? "" : " (not sealed)");
  text += "| figure | measured | 95 % interval | cases | bar |\n|---|---|---|---|---|\n";
  for (const Figure& f : s.figures) {
    const std::string label = f.text.substr(std::min(f.text.size(), f.text.find_first_not_of(' ')));
    text += fmt::format("| {} | {} | {} | {} | {}{} |\n", label, value_text(f), interval_text(f), count_text(f), f.bar,
                        f.met == Figure::Met::no_bar ? "" : fmt::format(" ({})", name(f.met)));
  }
  text += "\n| baseline | result |\n|---|---|\n";
  for (const Baseline& b : s.baselines) text += fmt::format("| {} | {} |\n", b.text, baseline_text(b));
  text += "\n| severity (noise floors) | cases | detected | right | right or tied |\n|---|---|---|---|---|\n";
  for (const SeverityBin& bin : by_severity(s.verdicts)) {
    const Tally& t = bin.tally;
    if (t.cases == 0) continue;
    text += fmt::format("| {} | {} | {} | {} | {} |\n", severity_label(bin), t.cases, percent(t.detected, t.cases),
                        percent(t.right, t.cases), percent(t.right_or_tied, t.cases));
  }
  return text;
}

}  // namespace umbsim
