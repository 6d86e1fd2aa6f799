#include "cli/output/calibration_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/text/wrapped_text.h"

namespace umbsim {
namespace {

using namespace calibration;

constexpr std::size_t kName = 16;
constexpr std::size_t kRecordings = 3;  // columns of errors side by side

std::string with_half_width(const Estimate& e, double unit, int digits) {
  std::string text = fmt::format("{:.{}f}", unit * e.value, digits);
  if (e.has_interval()) text += fmt::format(" +-{:.{}f}", unit * (e.high - e.low) / 2, digits);
  return text;
}

std::string parameters(const Comparison& c) {
  std::string text = fmt::format("Parameters, 95 % intervals\n  {:<{}}{:<21}{:<21}{:<20}\n", "", kName - 2, "E_d",
                                 "E_b", "mean radius mm");
  for (const MethodResult& r : c.results) {
    if (!r.fit) continue;
    const FitFigures f = figures(*r.fit, c.nominal);
    text += fmt::format("  {:<{}}{:<21}{:<21}{}\n", r.name, kName - 2, with_half_width(f.e_d, 1, 5),
                        with_half_width(f.e_b, 1, 5),
                        r.fit->scale_observed ? with_half_width(f.mean_radius_m, 1000, 4) : "cannot be seen");
  }
  for (const MethodResult& r : c.results) {
    if (!r.why_not.empty()) text += wrapped(fmt::format("  {:<{}}no answer: {}", r.name, kName - 2, r.why_not), kName);
  }
  return text;
}

std::string noise(const Comparison& c) {
  std::string text;
  for (const MethodResult& r : c.results) {
    if (!r.fit) continue;
    if (r.fit->noise && r.name == "kelly") {
      const auto& [left, right] = *r.fit->noise;
      text +=
          wrapped(fmt::format("  kelly: random errors of the wheels k_L {:.2f} [{:.2f}, {:.2f}], k_R {:.2f} [{:.2f}, "
                              "{:.2f}] mm per sqrt(m)",
                              1000 * left.value, 1000 * left.low, 1000 * left.high, 1000 * right.value,
                              1000 * right.low, 1000 * right.high),
                  4);
    }
    if (r.fit->scrub) {
      text +=
          wrapped(fmt::format("  scrub: tyres creep by {:.5f} [{:.5f}, {:.5f}] of their way against turning: so much "
                              "a turn in place is small, an arc of radius R by 2R/b times as much",
                              r.fit->scrub->value, r.fit->scrub->low, r.fit->scrub->high),
                  4);
    }
    for (const TrackerFit& t : r.fit->trackers) {
      if (r.name != "likelihood") continue;
      text += wrapped(fmt::format("  likelihood: tracker of {} turned {:+.2f} deg, marker {:+.1f} mm ahead, {:+.1f} mm "
                                  "left, clock {:+.0f} ms, rate {:+.3f} %",
                                  t.recording, degrees(t.heading_offset_rad), 1000 * t.marker_x_m, 1000 * t.marker_y_m,
                                  1000 * t.clock_offset_s, 100 * t.clock_rate),
                      4);
    }
  }
  return text;
}

struct Column {
  std::string title;
  bool test;
  std::size_t index;
};

std::vector<Column> columns(const Task& task) {
  std::vector<Column> all;
  for (std::size_t i = 0; i < task.train.size(); ++i) all.push_back({task.train_names[i], false, i});
  for (std::size_t i = 0; i < task.test.size(); ++i) all.push_back({"test " + task.test_names[i], true, i});
  return all;
}

std::string condition(const MethodResult& r) {
  if (!r.fit) return "";
  return std::isfinite(r.fit->condition) ? fmt::format("{:.3g}", r.fit->condition) : "inf";
}

// Left-out error, E_max and condition first, then recordings: as many tables as it takes.
std::string errors(const Comparison& c, const Task& task) {
  const std::vector<Column> all = columns(task);
  std::string text = wrapped("Mean error at the end of a run, mm: start and frame fitted (recorded start as exact)");
  for (std::size_t first = 0; first < all.size(); first += kRecordings) {
    const std::size_t last = std::min(all.size(), first + kRecordings);
    text += fmt::format("  {:<{}}", "", kName - 2);
    if (first == 0) text += fmt::format("{:>9}{:>8}{:>7}", "left out", "E_max", "cond.");
    for (std::size_t i = first; i < last; ++i) text += fmt::format("{:>13}", fmt::format("[{}]", i + 1));
    text += "\n";
    for (const MethodResult& r : c.results) {
      if (!r.why_not.empty()) continue;
      text += fmt::format("  {:<{}}", r.name, kName - 2);
      if (first == 0) {
        text += fmt::format("{:>9}{:>8}{:>7}",
                            fmt::format("{:.1f}{}", r.held_out_mm, r.fit && r.held_out_answers < c.folds ? "*" : ""),
                            r.e_max_m ? fmt::format("{:.1f}", 1000 * *r.e_max_m) : "-", condition(r));
      }
      for (std::size_t i = first; i < last; ++i) {
        const MeanError& e = all[i].test ? r.test[all[i].index] : r.train[all[i].index];
        text += fmt::format("{:>13}", fmt::format("{:.1f} ({:.1f})", e.final_mm, e.raw_final_mm));
      }
      text += "\n";
    }
  }
  for (std::size_t i = 0; i < all.size(); ++i) text += wrapped(fmt::format("  [{}] {}", i + 1, all[i].title), 6);
  text += wrapped(
      fmt::format("  left out: {}; * where a method has no answer without them, nominal stands in", c.held_out), 4);
  return text;
}

std::string parts(const Parts& p) {
  if (p.fits.empty()) return "";
  std::string text = fmt::format("Parts of the course, from headings\n  {:<30}{:<24}{}\n", "", "E_d", "E_b");
  std::string recording;
  for (const PartFit& f : p.fits) {
    if (f.recording != recording) text += wrapped("  " + f.recording, 4);
    recording = f.recording;
    text += fmt::format("    {:<28}{:<24}{}\n", f.part, f.e_d ? with_half_width(*f.e_d, 1, 5) : "",
                        f.e_b ? with_half_width(*f.e_b, 1, 5) : "");
  }
  return text;
}

std::string warnings(const Comparison& c) {
  std::string text;
  const auto say = [&](const std::string& what) { text += wrapped("Warning: " + what); };
  for (const std::string& w : c.warnings) say(w);
  for (const std::string& w : c.parts.warnings) say(w);
  for (const MethodResult& r : c.results) {
    if (!r.fit) continue;
    for (const std::string& w : r.fit->warnings) say(r.name + ": " + w);
  }
  return text;
}

}  // namespace

std::string comparison_table(const Comparison& c, const Task& task) {
  return parameters(c) + noise(c) + errors(c, task) + parts(c.parts) + warnings(c) +
         wrapped(fmt::format("Winner: {}: {}", c.results[c.winner].name, c.why));
}

}  // namespace umbsim
