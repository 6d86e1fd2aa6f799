#include "cli/tables.h"

#include <fmt/format.h>

namespace umbsim {
namespace {

double mm(double metres) { return metres * 1000; }

std::string cluster_header() {
  return fmt::format("  {:<12}{:>5}{:>11}{:>11}{:>11}{:>10}{:>10}{:>12}\n", "", "runs", "x_cg mm", "y_cg mm", "r_cg mm",
                     "sd mm", "SE mm", "heading deg");
}

std::string cluster_line(const char* label, const Cluster& c) {
  return fmt::format("  {:<12}{:>5}{:>11.3f}{:>11.3f}{:>11.3f}{:>10.3f}{:>10.3f}{:>12.4f}\n", label, c.errors.size(),
                     mm(c.centroid_x_m), mm(c.centroid_y_m), mm(c.r_cg_m), mm(c.sd_m), mm(c.standard_error_m),
                     degrees(c.heading_rad));
}

std::string estimate_line(const char* label, const ErrorEstimate& e) {
  return fmt::format("  {:<12}{:>14.5f}{:>14.5f}{:>12.6f}{:>12.6f}\n", label, degrees(e.alpha_rad),
                     degrees(e.beta_rad), e.e_d, e.e_b);
}

std::string injected_line(const InjectedErrors& injected) {
  return fmt::format("  {:<12}{:>14}{:>14}{:>12.6f}{:>12.6f}\n", "injected", "", "", injected.e_d, injected.e_b);
}

std::string one_way_table(const ExperimentResult& r) {
  std::string text = "One-way square (each direction alone)\n" + cluster_header();
  if (!r.cw.errors.empty()) text += cluster_line("cw", r.cw);
  if (!r.ccw.errors.empty()) text += cluster_line("ccw", r.ccw);
  text += "  One E_d can hide one E_b in either direction: a one-way test is unfit for differential drives.\n";
  return text;
}

std::string recovery_table(const ExperimentResult& r) {
  std::string text = fmt::format("Calibration ({} form), proved by driving again\n", name(r.scenario.calibration.method));
  text += cluster_header();
  for (const CalibrationPass& pass : r.passes) {
    text += cluster_line("cw", pass.umbmark.cw) + cluster_line("ccw", pass.umbmark.ccw);
  }
  const CalibrationPass& last = r.passes.back();
  const double before_m = r.umbmark->e_max_syst_m, after_m = last.umbmark.e_max_syst_m;
  text += fmt::format("  E_max,syst {:.3f} mm -> {:.3f} mm", mm(before_m), mm(after_m));
  if (after_m > 0) text += fmt::format("  ({:.3g} times smaller, {} pass{})", before_m / after_m, r.passes.size(), r.passes.size() == 1 ? "" : "es");
  const double e_d = last.odometry.right_radius_m / last.odometry.left_radius_m * r.odometry.left_radius_m /
                     r.odometry.right_radius_m;
  const double e_b = last.odometry.wheelbase_m / r.odometry.wheelbase_m;
  text += fmt::format("\n  recovered E_d {:.6f} ({:+.1e}), E_b {:.6f} ({:+.1e})\n", e_d, e_d - r.injected.e_d, e_b,
                      e_b - r.injected.e_b);
  return text;
}

}  // namespace

std::string umbmark_table(const Umbmark& u) {
  std::string text = "Two-way square (UMBmark): error = absolute - calculated\n" + cluster_header();
  text += cluster_line("cw", u.cw) + cluster_line("ccw", u.ccw);
  text += fmt::format("  E_max,syst {:.3f} mm\n", mm(u.e_max_syst_m));
  text += "Systematic errors\n";
  text += fmt::format("  {:<12}{:>14}{:>14}{:>12}{:>12}\n", "", "alpha deg (A)", "beta deg (B)", "E_d", "E_b");
  text += estimate_line("endpoint", u.endpoint) + estimate_line("  from y", u.endpoint_y) +
          estimate_line("heading", u.heading);
  text += fmt::format("  type A (wheelbase) {:.0f} %, type B (diameters) {:.0f} %\n", 100 * u.type_a_share,
                      100 * u.type_b_share);
  return text;
}

std::string extended_table(const ExtendedUmbmark& e) {
  return fmt::format(
      "Extended UMBmark (mean absolute heading error with cables)\n"
      "  cw {:.4f} deg + ccw {:.4f} deg = {:.4f} deg;  {:.4f} deg per cable\n",
      degrees(e.cw_mean_abs_heading_error_rad), degrees(e.ccw_mean_abs_heading_error_rad),
      degrees(e.mean_abs_heading_error_rad), degrees(e.per_bump_heading_error_rad));
}

std::string experiment_table(const ExperimentResult& r) {
  std::string text = fmt::format("{}: {} on a {} m square\n", r.scenario.name, r.nominal.urdf, r.scenario.course.side_m);
  if (!r.umbmark) return text + one_way_table(r);
  text += umbmark_table(*r.umbmark) + injected_line(r.injected);
  const double smaller_m = std::min(r.umbmark->cw.r_cg_m, r.umbmark->ccw.r_cg_m);
  if (smaller_m < r.umbmark->e_max_syst_m / 10) {
    text += fmt::format("  Note: the {} square alone would have reported {:.1f} mm. A one-way test is unfit for "
                        "differential drives.\n",
                        r.umbmark->cw.r_cg_m < r.umbmark->ccw.r_cg_m ? "cw" : "ccw", mm(smaller_m));
  }
  if (r.extended) text += extended_table(*r.extended);
  if (!r.passes.empty()) text += recovery_table(r);
  text += fmt::format("Cost: {:.1f} simulated s in {:.2f} s, {} steps, {} solver fallbacks\n", r.cost.simulated_s,
                      r.wall_s, r.cost.steps, r.cost.solver_fallbacks);
  return text;
}

}  // namespace umbsim
