#include "cli/output/tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "cli/output/colour.h"
#include "core/text/wrapped_text.h"
#include "experiment/drive/cable_layer.h"
#include "experiment/scenario/read_course.h"
#include "experiment/wheel_loads.h"

namespace umbsim {
namespace {

double mm(double metres) { return metres * 1000; }

std::string cluster_header() {
  return fmt::format("  {:<12}{:>5}{:>10}{:>10}{:>10}{:>9}{:>9}{:>12}\n", "", "runs", "x_cg mm", "y_cg mm", "r_cg mm",
                     "sd mm", "SE mm", "heading deg");
}

std::string cluster_line(const char* label, const Cluster& c) {
  return fmt::format("  {:<12}{:>5}{:>10.3f}{:>10.3f}{:>10.3f}{:>9.3f}{:>9.3f}{:>12.4f}\n", label, c.errors.size(),
                     mm(c.centroid_x_m), mm(c.centroid_y_m), mm(c.r_cg_m), mm(c.sd_m), mm(c.standard_error_m),
                     degrees(c.heading_rad));
}

std::string estimate_line(const char* label, const ErrorEstimate& e, const char* remark = "") {
  return fmt::format("  {:<12}{:>14.5f}{:>14.5f}{:>12.6f}{:>12.6f}{}\n", label, degrees(e.alpha_rad),
                     degrees(e.beta_rad), e.e_d, e.e_b, remark);
}

std::string form_lines(const Umbmark& u, CalibrationMethod form, bool applied) {
  const std::string line = estimate_line(name(form), estimate(u, form), applied ? "  applied" : "");
  return form == CalibrationMethod::heading ? line : line + estimate_line("  from y", u.endpoint_y);
}

std::string injected_line(const InjectedErrors& injected) {
  return fmt::format("  {:<12}{:>14}{:>14}{:>12.6f}{:>12.6f}\n", "injected", "", "", injected.e_d, injected.e_b);
}

std::string one_way_table(const ExperimentResult& r) {
  const bool square = r.scenario.course.shape == "square";
  std::string text =
      (square ? "One-way square" : "Return errors") + std::string(" (each direction alone)\n") + cluster_header();
  if (!r.cw.errors.empty()) text += cluster_line("cw", r.cw);
  if (!r.ccw.errors.empty()) text += cluster_line("ccw", r.ccw);
  if (square || r.cw.errors.empty() || r.ccw.errors.empty())
    return text +
           wrapped("  One E_d can hide one E_b in either direction: a one-way test is unfit for differential drives.");
  return text + wrapped("  Figures of UMBmark are those of squares. For this course see `umbsim calibrate`.");
}

std::string shares_line(const char* label, const ErrorShares& s) {
  const auto part = [](double m, double share) { return fmt::format("{:.3f} mm ({:5.1f} %)", mm(m), 100 * share); };
  return fmt::format("  {:<12}{:>12.3f}{:>26}{:>26}\n", label, mm(s.rms_m), part(s.systematic_m, s.systematic),
                     part(s.non_systematic_m, s.non_systematic));
}

// One-way against two-way, and systematic against non-systematic (lecture 7.3 and 7.4).
std::string comparison_table(const ExperimentResult& r) {
  std::string text;
  if (r.umbmark) {
    text += "One-way against two-way\n";
    text +=
        wrapped(fmt::format("  one-way cw {:.3f} mm, {:.4f} deg; one-way ccw {:.3f} mm, {:.4f} deg; two-way "
                            "E_max,syst {:.3f} mm",
                            mm(r.cw.r_cg_m), degrees(r.cw.heading_rad), mm(r.ccw.r_cg_m), degrees(r.ccw.heading_rad),
                            mm(r.umbmark->e_max_syst_m)));
  }
  if (std::max(r.cw.errors.size(), r.ccw.errors.size()) < 2) return text;  // one run has no spread
  text += "Systematic against non-systematic: rms^2 = r_cg^2 + spread^2\n";
  text += fmt::format("  {:<12}{:>12}{:>26}{:>26}\n", "", "rms mm", "systematic", "non-systematic");
  std::vector<ErrorShares> directions;
  for (const auto& [c, direction] : {std::pair{&r.cw, "cw"}, std::pair{&r.ccw, "ccw"}}) {
    if (c->errors.empty()) continue;
    directions.push_back(error_shares(*c));
    text += shares_line(direction, directions.back());
  }
  return directions.size() < 2 ? text : text + shares_line("both", error_shares(directions));
}

std::string uncertainty_line(const ExperimentResult& r) {
  std::vector<const PoseTrack*> tracks;
  for (int i = 0; i < int(r.cw.errors.size() + r.ccw.errors.size()); ++i) tracks.push_back(&r.tracks[std::size_t(i)]);
  const UncertaintyFigures f = uncertainty_figures(tracks);
  if (f.runs == 0) return "";
  double a_m = 0, b_m = 0;
  for (const PoseTrack* track : tracks) {
    const Ellipse e = ellipse_95(track->end->estimate.covariance);
    a_m += e.a_m / f.runs, b_m += e.b_m / f.runs;
  }
  return wrapped(fmt::format(
      "Pose uncertainty: 95 % ellipse of the end, semi-axes {:.1f} and {:.1f} mm; true end inside in {:.0f} % of {} "
      "runs",
      mm(a_m), mm(b_m), 100 * f.end_inside_95_share, f.runs));
}

std::string recovery_table(const ExperimentResult& r) {
  std::string text =
      fmt::format("Calibration ({} form), proved by driving again\n", name(r.scenario.calibration.method));
  text += cluster_header();
  for (const CalibrationPass& pass : r.passes) {
    text += cluster_line("cw", pass.umbmark.cw) + cluster_line("ccw", pass.umbmark.ccw);
  }
  const CalibrationPass& last = r.passes.back();
  const double before_m = r.umbmark->e_max_syst_m, after_m = last.umbmark.e_max_syst_m;
  text += fmt::format("  E_max,syst {:.3f} mm -> {:.3f} mm", mm(before_m), mm(after_m));
  if (after_m > 0)
    text += fmt::format("  ({:.3g} times smaller, {} pass{})", before_m / after_m, r.passes.size(),
                        r.passes.size() == 1 ? "" : "es");
  const double e_d =
      last.odometry.right_radius_m / last.odometry.left_radius_m * r.odometry.left_radius_m / r.odometry.right_radius_m;
  const double e_b = last.odometry.wheelbase_m / r.odometry.wheelbase_m;
  text += fmt::format("\n  recovered E_d {:.6f} ({:+.1e}), E_b {:.6f} ({:+.1e})\n", e_d, e_d - r.injected.e_d, e_b,
                      e_b - r.injected.e_b);
  return text;
}

std::string loads_line(const ExperimentResult& r) {
  const auto loads = wheel_loads(r);
  return wrapped(fmt::format("Wheel loads: left {:.1f} N, at least {:.1f} N; right {:.1f} N, at least {:.1f} N",
                             loads[0].mean_n, loads[0].least_n, loads[1].mean_n, loads[1].least_n)) +
         [&] {
           std::string text;
           for (const std::string& warning : run_warnings(r)) text += wrapped("  Warning: " + warning + ".");
           return text;
         }();
}

std::string cables_line(const ExperimentResult& r) {
  std::string text;
  const LaidBumps& laid = r.scenario.bumps.laid;
  if (r.cables.not_crossed > 0) {
    text += wrapped(
        fmt::format("  Warning: the wheel did not get over {} of the laid cables of {} mm: too little friction.",
                    r.cables.not_crossed, mm(laid.height_m)));
  }
  if (r.cables.without_grip > 0) {
    text += wrapped(fmt::format(
        "  Warning: the wheel cannot climb {} of the laid cables on its own traction: friction is below tan "
        "psi = {:.2f}. Its slip, not the cable, turned the robot.",
        r.cables.without_grip, climbing_friction(r.nominal.wheels[0].radius_m, laid.height_m)));
  }
  return text;
}

}  // namespace

std::string umbmark_table(const Umbmark& u, std::optional<CalibrationMethod> applied,
                          std::optional<InjectedErrors> injected) {
  std::string text = "Two-way square (UMBmark): error = absolute - calculated\n" + cluster_header();
  text += cluster_line("cw", u.cw) + cluster_line("ccw", u.ccw);
  text += fmt::format("  E_max,syst {:.3f} mm\n", mm(u.e_max_syst_m));
  text += "Systematic errors\n";
  text += fmt::format("  {:<12}{:>14}{:>14}{:>12}{:>12}\n", "", "alpha deg (A)", "beta deg (B)", "E_d", "E_b");
  std::array forms{CalibrationMethod::endpoint, CalibrationMethod::heading};
  if (applied == CalibrationMethod::heading) std::swap(forms[0], forms[1]);
  for (const CalibrationMethod form : forms) text += form_lines(u, form, applied == form);
  if (injected) text += injected_line(*injected);
  text += fmt::format("  type A (wheelbase) {:.0f} %, type B (diameters) {:.0f} %\n", 100 * u.type_a_share,
                      100 * u.type_b_share);
  for (const CalibrationMethod form : forms)
    text += wrapped(fmt::format("  {}: {}", name(form), when_to_trust(form)), 4);
  return text;
}

std::string extended_table(const ExtendedUmbmark& e) {
  return "Extended UMBmark (mean absolute heading error with cables)\n" +
         wrapped(fmt::format("  cw {:.4f} deg + ccw {:.4f} deg = {:.4f} deg;  {:.4f} deg per cable",
                             degrees(e.cw_mean_abs_heading_error_rad), degrees(e.ccw_mean_abs_heading_error_rad),
                             degrees(e.mean_abs_heading_error_rad), degrees(e.per_bump_heading_error_rad)));
}

std::string experiment_table(const ExperimentResult& r) {
  std::string text =
      wrapped(fmt::format("{}: {} on {}", r.scenario.name, r.nominal.urdf, course_in_words(r.scenario.course)));
  if (!r.umbmark)
    return text + one_way_table(r) + cables_line(r) + comparison_table(r) + uncertainty_line(r) + loads_line(r);
  text += umbmark_table(*r.umbmark, r.applied(), r.injected);
  const double smaller_m = std::min(r.umbmark->cw.r_cg_m, r.umbmark->ccw.r_cg_m);
  if (smaller_m < r.umbmark->e_max_syst_m / 10) {
    text +=
        wrapped(fmt::format("  Note: the {} square alone would have reported {:.1f} mm. A one-way test is unfit "
                            "for differential drives.",
                            r.umbmark->cw.r_cg_m < r.umbmark->ccw.r_cg_m ? "cw" : "ccw", mm(smaller_m)));
  }
  text += comparison_table(r);
  if (r.extended) text += extended_table(*r.extended) + cables_line(r);
  text += uncertainty_line(r);
  if (!r.passes.empty()) text += recovery_table(r);
  text += loads_line(r);
  text += wrapped(fmt::format("Cost: {:.1f} simulated s in {:.2f} s, {} steps, {} solver fallbacks", r.cost.simulated_s,
                              r.wall_s, r.cost.steps, r.cost.solver_fallbacks));
  return text;
}

void print_warnings(const std::vector<std::string>& warnings) {
  for (const std::string& warning : warnings) print_error("warning: " + warning);
}

}  // namespace umbsim
