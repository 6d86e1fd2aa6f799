#include "gap/trial/score/baselines.h"

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <functional>

#include "calibration/calibrate.h"

namespace umbsim {
namespace {

constexpr double kTail = 0.025;

bool plain(const RecordedRun& run) {
  return !run.start_heading_rad && !run.linear_speed_mps && !run.turn && !run.payload_kg && run.bumps.empty();
}

double mean(const std::vector<ReturnError>& errors) {
  double sum = 0;
  for (const ReturnError& e : errors) sum += e.theta_rad;
  return sum / double(errors.size());
}

double squares(const std::vector<ReturnError>& errors) {
  const double m = mean(errors);
  double sum = 0;
  for (const ReturnError& e : errors) sum += (e.theta_rad - m) * (e.theta_rad - m);
  return sum;
}

std::string commonest(const std::vector<Verdict>& verdicts) {
  std::string best;
  std::map<std::string, int> counts;
  for (const Verdict& v : verdicts) {
    if (!single_and_detectable(v)) continue;
    if (++counts[v.truth] > (best.empty() ? 0 : counts[best])) best = v.truth;
  }
  return best;
}

std::string largest_drop(const Verdict& v) {
  const Cause* best = nullptr;
  for (const Cause& cause : v.diagnosis.causes) {
    if (cause.effects.size() != 1 || !cause.squared_error_drop) continue;
    if (!best || *cause.squared_error_drop > *best->squared_error_drop) best = &cause;
  }
  return best ? joined(best->effects) : "";
}

Baseline evaluate(const char* key, const char* text, const std::vector<Verdict>& verdicts,
                  const std::function<std::string(std::size_t)>& named) {
  Baseline b{key, text, 0, 0, 0, 0, ""};
  for (std::size_t i = 0; i < verdicts.size(); ++i) {
    if (verdicts[i].answer.tier == Tier::no_effect) {
      ++b.no_effect_cases;
      b.false_alarms += named(i) != "none";
    } else if (single_and_detectable(verdicts[i])) {
      ++b.cases;
      b.right += named(i) == verdicts[i].truth;
    }
  }
  return b;
}

}  // namespace

std::string umbmark_alone(const Recording& recording) {
  Recording squares_only = recording;
  squares_only.runs.clear();
  for (const RecordedRun& run : recording.runs) {
    if (plain(run)) squares_only.runs.push_back(run);
  }
  const RecordedRobot& r = recording.robot;
  const OdometryParameters odometry{r.wheel_radius_m, r.wheel_radius_m, r.wheelbase_m, r.ticks_per_revolution};
  const std::vector<ReturnError> cw = return_errors(squares_only, odometry, "cw", false);
  const std::vector<ReturnError> ccw = return_errors(squares_only, odometry, "ccw", false);
  if (cw.size() < 2 || ccw.size() < 2) return "none";  // without a spread nothing stands out
  const double freedom = double(cw.size() + ccw.size() - 2);
  const double sd = std::sqrt((squares(cw) + squares(ccw)) / freedom);
  const double limit = sd * std::sqrt(1.0 / double(cw.size()) + 1.0 / double(ccw.size())) *
                       boost::math::quantile(boost::math::complement(boost::math::students_t(freedom), kTail));
  // Type A errors turn against each other in the two directions, type B errors alike (Borenstein & Feng 1995).
  const double type_a = std::abs(mean(ccw) - mean(cw)), type_b = std::abs(mean(ccw) + mean(cw));
  if (std::max(type_a, type_b) <= limit) return "none";
  return type_a > type_b ? "wheelbase" : "wheel_radius_difference";
}

std::vector<Baseline> baselines(const std::vector<Verdict>& verdicts, const std::vector<std::string>& umbmark) {
  const std::string most = commonest(verdicts);
  std::vector<Baseline> all;
  all.push_back(
      evaluate("commonest", "always naming the commonest effect", verdicts, [&](std::size_t) { return most; }));
  if (umbmark.size() == verdicts.size()) {
    all.push_back(evaluate("umbmark", "UMBmark alone", verdicts, [&](std::size_t i) { return umbmark[i]; }));
  } else {
    all.push_back({"umbmark", "UMBmark alone", 0, 0, 0, 0, "the recordings are not here"});
  }
  const bool stated = std::any_of(verdicts.begin(), verdicts.end(),
                                  [](const Verdict& v) { return !largest_drop(v).empty(); });
  const char* text = "the single effect with the largest drop in squared error";
  if (stated) {
    all.push_back(evaluate("squared_error", text, verdicts, [&](std::size_t i) { return largest_drop(verdicts[i]); }));
  } else {
    all.push_back({"squared_error", text, 0, 0, 0, 0, "the diagnoses do not state squared_error_drop"});
  }
  return all;
}

}  // namespace umbsim
