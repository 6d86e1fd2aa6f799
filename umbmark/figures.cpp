#include "umbmark/figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/error.h"

namespace umbsim {
namespace {

// Shares of errors smaller than this would be shares of round-off.
constexpr double kRoundOff_rad = 1e-6;

double mean_abs_deviation(const Cluster& bumped, double plain_heading_rad) {
  double sum = 0;
  for (const ReturnError& e : bumped.errors) sum += std::abs(e.theta_rad - plain_heading_rad);
  return sum / double(bumped.errors.size());
}

}  // namespace

bool is_bumped(const RecordedRun& run) { return !run.bumps.empty() || run.inner_wheel_bumps.value_or(0) > 0; }

int bump_count(const Recording& recording) {
  int count = 0;
  for (const RecordedRun& run : recording.runs) {
    if (is_bumped(run)) count = std::max(count, run.inner_wheel_bumps.value_or(int(run.bumps.size())));
  }
  return count;
}

ReturnError return_error(const RecordedRun& run, const OdometryParameters& odometry) {
  if (run.truth.size() < 2) throw InputError(fmt::format("run {}: no absolute pose at start and end", run.id));
  if (run.encoders.size() < 2) throw InputError(fmt::format("run {}: no encoder data", run.id));
  const EncoderSample& first = run.encoders.front();
  DeadReckoning reckoning(odometry, {}, first.left_ticks, first.right_ticks);
  for (const EncoderSample& sample : run.encoders) reckoning.update(sample.left_ticks, sample.right_ticks);
  const Pose2 absolute = inverse(run.truth.front().X_WB) * run.truth.back().X_WB;
  return return_error(run.id, absolute, reckoning.pose());
}

ReturnError return_error(const std::string& run, const Pose2& absolute, const Pose2& calculated) {
  const int laps = std::max(1, int(std::lround(std::abs(calculated.theta_rad) / (2 * M_PI))));
  return {run, absolute.x_m - calculated.x_m, absolute.y_m - calculated.y_m, absolute.theta_rad - calculated.theta_rad,
          laps};
}

std::vector<ReturnError> return_errors(const Recording& recording, const OdometryParameters& odometry,
                                       const std::string& direction, bool bumped) {
  std::vector<ReturnError> errors;
  for (const RecordedRun& run : recording.runs) {
    if (run.direction == direction && is_bumped(run) == bumped) errors.push_back(return_error(run, odometry));
  }
  return errors;
}

Cluster cluster(std::vector<ReturnError> errors) {
  Cluster c;
  c.errors = std::move(errors);
  const double n = double(c.errors.size());
  if (n == 0) return c;
  c.laps = 0;
  for (const ReturnError& e : c.errors) {
    c.laps += e.laps / n;
    c.centroid_x_m += e.x_m / n;
    c.centroid_y_m += e.y_m / n;
    c.heading_rad += e.theta_rad / n;
  }
  c.r_cg_m = std::hypot(c.centroid_x_m, c.centroid_y_m);
  if (n < 2) return c;
  double xx = 0, yy = 0, tt = 0;
  for (const ReturnError& e : c.errors) {
    xx += std::pow(e.x_m - c.centroid_x_m, 2) / (n - 1);
    yy += std::pow(e.y_m - c.centroid_y_m, 2) / (n - 1);
    tt += std::pow(e.theta_rad - c.heading_rad, 2) / (n - 1);
  }
  c.sd_x_m = std::sqrt(xx);
  c.sd_y_m = std::sqrt(yy);
  c.sd_heading_rad = std::sqrt(tt);
  c.sd_m = std::sqrt((xx + yy) / 2);
  c.standard_error_m = c.sd_m / std::sqrt(n);
  return c;
}

namespace {

ErrorShares shares_of_squares(double systematic_m2, double non_systematic_m2) {
  ErrorShares s;
  const double total_m2 = systematic_m2 + non_systematic_m2;
  s.rms_m = std::sqrt(total_m2);
  s.systematic_m = std::sqrt(systematic_m2);
  s.non_systematic_m = std::sqrt(non_systematic_m2);
  if (total_m2 == 0) return s;
  s.systematic = systematic_m2 / total_m2;
  s.non_systematic = non_systematic_m2 / total_m2;
  return s;
}

}  // namespace

ErrorShares error_shares(const Cluster& c) {
  double spread_m2 = 0;
  for (const ReturnError& e : c.errors) {
    const double x = e.x_m - c.centroid_x_m, y = e.y_m - c.centroid_y_m;
    spread_m2 += (x * x + y * y) / double(c.errors.size());
  }
  return shares_of_squares(c.r_cg_m * c.r_cg_m, c.errors.size() > 1 ? spread_m2 : 0);
}

ErrorShares error_shares(const std::vector<ErrorShares>& directions) {
  double systematic_m2 = 0, non_systematic_m2 = 0;
  for (const ErrorShares& d : directions) {
    systematic_m2 += d.systematic_m * d.systematic_m / double(directions.size());
    non_systematic_m2 += d.non_systematic_m * d.non_systematic_m / double(directions.size());
  }
  return shares_of_squares(systematic_m2, non_systematic_m2);
}

// Borenstein & Feng 1996: R = (L/2) / sin(beta/2), E_d = (R + b/2) / (R - b/2), E_b = 90 deg / (90 deg - alpha).
// Written with 1/R, which stays finite for beta = 0.
ErrorEstimate error_estimate(double alpha_rad, double beta_rad, double side_m, double wheelbase_m) {
  ErrorEstimate e;
  e.alpha_rad = alpha_rad;
  e.beta_rad = beta_rad;
  const double half_b_over_R = wheelbase_m / 2 * std::sin(beta_rad / 2) / (side_m / 2);
  e.e_d = (1 + half_b_over_R) / (1 - half_b_over_R);
  e.e_b = M_PI / 2 / (M_PI / 2 - alpha_rad);
  e.left_factor = 2 / (e.e_d + 1);
  e.right_factor = 2 / (1 / e.e_d + 1);
  return e;
}

// Exact for any size of error: a leg turns the robot by beta = 2 L (E_d - 1) / ((E_d + 1) b_actual), a turn by
// 90 deg / E_b.
ErrorEstimate heading_estimate(double alpha_rad, double beta_rad, double side_m, double wheelbase_m) {
  ErrorEstimate e = error_estimate(alpha_rad, beta_rad, side_m, wheelbase_m);
  const double half_b_over_R = e.e_b * wheelbase_m / 2 * beta_rad / side_m;
  e.e_d = (1 + half_b_over_R) / (1 - half_b_over_R);
  e.left_factor = 2 / (e.e_d + 1);
  e.right_factor = 2 / (1 / e.e_d + 1);
  return e;
}

Umbmark umbmark(Cluster cw, Cluster ccw, double side_m, double nominal_wheelbase_m) {
  if (cw.errors.empty() || ccw.errors.empty()) throw std::invalid_argument("UMBmark needs both directions");
  Umbmark u;
  u.e_max_syst_m = std::max(cw.r_cg_m, ccw.r_cg_m);
  // A lap's turns and legs, by a number of each direction's runs: a sum over both tells the one, a difference the
  // other.
  const auto both = [&](double of_cw, double of_ccw) { return of_cw / cw.laps + of_ccw / ccw.laps; };
  const double L4 = -4 * side_m;
  u.endpoint = error_estimate(both(cw.centroid_x_m, ccw.centroid_x_m) / L4,
                              both(cw.centroid_x_m, -ccw.centroid_x_m) / L4, side_m, nominal_wheelbase_m);
  u.endpoint_y = error_estimate(both(cw.centroid_y_m, -ccw.centroid_y_m) / L4,
                                both(cw.centroid_y_m, ccw.centroid_y_m) / L4, side_m, nominal_wheelbase_m);
  // Four turns and four legs: theta_cw = 4 (alpha + beta), theta_ccw = 4 (-alpha + beta).
  u.heading = heading_estimate(both(cw.heading_rad, -ccw.heading_rad) / 8, both(cw.heading_rad, ccw.heading_rad) / 8,
                               side_m, nominal_wheelbase_m);
  const double total = std::abs(u.heading.alpha_rad) + std::abs(u.heading.beta_rad);
  if (total > kRoundOff_rad) {
    u.type_a_share = std::abs(u.heading.alpha_rad) / total;
    u.type_b_share = std::abs(u.heading.beta_rad) / total;
  }
  u.cw = std::move(cw);
  u.ccw = std::move(ccw);
  return u;
}

Umbmark umbmark(const Recording& recording, const OdometryParameters& odometry) {
  if (recording.path.shape != "square") {
    throw InputError(fmt::format("path.shape: UMBmark needs squares, this recording has '{}'", recording.path.shape));
  }
  Cluster cw = cluster(return_errors(recording, odometry, "cw", false));
  Cluster ccw = cluster(return_errors(recording, odometry, "ccw", false));
  for (const auto& [c, direction] : {std::pair{&cw, "cw"}, std::pair{&ccw, "ccw"}}) {
    if (c->errors.empty())
      throw InputError(fmt::format("runs: UMBmark needs both directions, there is no {} run", direction));
  }
  return umbmark(std::move(cw), std::move(ccw), recording.path.side_m, odometry.wheelbase_m);
}

ExtendedUmbmark extended_umbmark(Cluster cw, Cluster ccw, const Umbmark& plain, int bumps) {
  ExtendedUmbmark e;
  e.cw = std::move(cw);
  e.ccw = std::move(ccw);
  e.cw_mean_abs_heading_error_rad = mean_abs_deviation(e.cw, plain.cw.heading_rad);
  e.ccw_mean_abs_heading_error_rad = mean_abs_deviation(e.ccw, plain.ccw.heading_rad);
  e.mean_abs_heading_error_rad = e.cw_mean_abs_heading_error_rad + e.ccw_mean_abs_heading_error_rad;
  if (bumps > 0) e.per_bump_heading_error_rad = e.mean_abs_heading_error_rad / 2 / bumps;
  return e;
}

std::optional<ExtendedUmbmark> extended_umbmark(const Recording& recording, const OdometryParameters& odometry,
                                                const Umbmark& plain) {
  Cluster cw = cluster(return_errors(recording, odometry, "cw", true));
  Cluster ccw = cluster(return_errors(recording, odometry, "ccw", true));
  if (cw.errors.empty() || ccw.errors.empty()) return std::nullopt;
  return extended_umbmark(std::move(cw), std::move(ccw), plain, bump_count(recording));
}

}  // namespace umbsim
