#include "calibration/compare/parts.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <set>

#include "calibration/compare/heading_pieces.h"
#include "calibration/methods/paths/pieces.h"

namespace umbsim::calibration {
namespace {

constexpr double kBlind = 1e6;          // condition number beyond which headings do not tell both wheels apart
constexpr double kStandsOut = 4;        // robust standard deviations
constexpr std::size_t kLaterLegs = 2;   // of each run, at least: what legs usually do
constexpr double kLeastOff_rad = 0.01;  // a start heading that is off by less harms nothing that is seen here

using Pieces = std::vector<HeadingPiece>;

// (log E_d, log E_b) from headings, and whether each was to be had. One unknown, E_d, on straight legs.
struct Answer {
  Eigen::Vector2d logs = Eigen::Vector2d::Zero();
  bool both = false;
};

Answer solve(const Pieces& pieces, const OdometryParameters& nominal, bool straight) {
  Eigen::Matrix2d normal = Eigen::Matrix2d::Zero();
  Eigen::Vector2d right = Eigen::Vector2d::Zero();
  double way2 = 0, product = 0;
  const double b = nominal.wheelbase_m;
  for (const HeadingPiece& p : pieces) {
    const Eigen::Vector2d row(-p.left_m / b, p.right_m / b);
    normal += row * row.transpose();
    right += row * p.tracked_rad;
    const double way = (p.left_m + p.right_m) / 2;
    way2 += way * way;
    product += way * (p.tracked_rad * b - (p.right_m - p.left_m));
  }
  Answer a;
  a.both = !straight && condition_number(normal) < kBlind;
  if (straight) a.logs[0] = product / way2;
  if (!a.both) return a;
  const Eigen::Vector2d x = normal.ldlt().solve(right);  // c_L / b, c_R / b
  a.both = x.minCoeff() > 0;
  if (a.both) a.logs = {std::log(x[1] / x[0]), -(std::log(x[0]) + std::log(x[1])) / 2};
  return a;
}

Estimate with_spread(double value, double variance, double dof) {
  const double half = t_95(dof) * std::sqrt(variance);
  return {std::exp(value), std::exp(value - half), std::exp(value + half)};
}

// With intervals by leaving out one run at a time.
PartFit part(const std::string& recording, const std::string& name, const Pieces& pieces,
             const OdometryParameters& nominal, bool straight) {
  PartFit fit{recording, name, pieces.size(), {}, {}, 0};
  std::set<std::size_t> runs;
  for (const HeadingPiece& p : pieces) runs.insert(p.run);
  const double n = double(runs.size());
  if (runs.size() < 3) return fit;
  const Answer all = solve(pieces, nominal, straight);
  if (!straight && !all.both) return fit;
  std::vector<Eigen::Vector2d> left_out;
  Eigen::Vector2d mean = Eigen::Vector2d::Zero(), variance = Eigen::Vector2d::Zero();
  for (const std::size_t run : runs) {
    Pieces others;
    std::copy_if(pieces.begin(), pieces.end(), std::back_inserter(others),
                 [&](const HeadingPiece& p) { return p.run != run; });
    left_out.push_back(solve(others, nominal, straight).logs);
    mean += left_out.back() / n;
  }
  for (const Eigen::Vector2d& l : left_out) variance += (n - 1) / n * (l - mean).cwiseAbs2();
  fit.degrees_of_freedom = n - (straight ? 1 : 2);
  fit.e_d = with_spread(all.logs[0], variance[0], fit.degrees_of_freedom);
  if (!straight) fit.e_b = with_spread(all.logs[1], variance[1], fit.degrees_of_freedom);
  return fit;
}

bool disagree(const Estimate& a, const Estimate& b) {
  const double half = std::hypot(std::log(a.high / a.value), std::log(b.high / b.value));
  return std::abs(std::log(a.value / b.value)) > half;
}

void compare(const PartFit& a, const PartFit& b, std::vector<std::string>& warnings) {
  const auto say = [&](const char* what, const Estimate& x, const Estimate& y) {
    warnings.push_back(fmt::format(
        "parts disagree beyond their intervals: {} of {} ({}) is {:.5f} [{:.5f}, {:.5f}], of {} ({}) {:.5f} [{:.5f}, "
        "{:.5f}]. No single wheelbase and ratio fits both; prefer runs like those to come",
        what, a.part, a.recording, x.value, x.low, x.high, b.part, b.recording, y.value, y.low, y.high));
  };
  if (a.e_b && b.e_b && disagree(*a.e_b, *b.e_b)) say("E_b", *a.e_b, *b.e_b);
  if (a.e_d && b.e_d && disagree(*a.e_d, *b.e_d)) say("E_d", *a.e_d, *b.e_d);
}

double robust_spread(const Pieces& pieces, const OdometryParameters& nominal) {
  std::vector<double> off;
  for (const HeadingPiece& p : pieces)
    off.push_back(std::abs(p.tracked_rad - (p.right_m - p.left_m) / nominal.wheelbase_m));
  if (off.empty()) return 0;
  std::nth_element(off.begin(), off.begin() + std::ptrdiff_t(off.size() / 2), off.end());
  return 1.4826 * off[off.size() / 2];
}

// A heading that the robot has left before its first straight is no start heading.
void check_starts(const Runs& runs, const std::string& recording, const HeadingPieces& pieces,
                  const OdometryParameters& nominal, Parts& parts) {
  if (pieces.later.size() < kLaterLegs * pieces.first.size()) return;
  const double usual = robust_spread(pieces.later, nominal);
  const StartHeading* worst = nullptr;
  const std::size_t before = parts.starts.size();
  for (const HeadingPiece& p : pieces.first) {
    const double off = p.tracked_rad - (p.right_m - p.left_m) / nominal.wheelbase_m;
    parts.starts.push_back({recording, runs[p.run].run->id, off, usual});
  }
  for (std::size_t i = before; i < parts.starts.size(); ++i) {
    const StartHeading& s = parts.starts[i];
    if (std::abs(s.off_rad) < std::max(kStandsOut * usual, kLeastOff_rad)) continue;
    if (!worst || std::abs(s.off_rad) > std::abs(worst->off_rad)) worst = &s;
  }
  if (!worst) return;
  parts.warnings.push_back(fmt::format(
      "{}: up to the middle of the first leg run {} turns {:+.2f} deg more than its wheels say; later legs do so by "
      "{:.2f} deg. Methods that take the recorded start heading for exact (endpoint, iterated, heading) put this into "
      "wheelbase and ratio",
      recording, worst->run, degrees(worst->off_rad), degrees(usual)));
}

}  // namespace

Parts fit_parts(const Runs& runs, const std::vector<std::string>& names, const OdometryParameters& nominal) {
  Parts parts;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const HeadingPieces pieces = heading_pieces(runs, i, nominal);
    const std::size_t first = parts.fits.size();
    for (const auto& [label, part_pieces] :
         {std::pair{"whole runs", &pieces.whole}, std::pair{"turns, straight to straight", &pieces.turns},
          std::pair{"curves", &pieces.curves}, std::pair{"legs", &pieces.legs}}) {
      const PartFit fit = part(names[i], label, *part_pieces, nominal, part_pieces == &pieces.legs);
      if (fit.e_d) parts.fits.push_back(fit);
    }
    check_starts(runs, names[i], pieces, nominal, parts);
    for (std::size_t a = first; a < parts.fits.size(); ++a)
      for (std::size_t b = a + 1; b < parts.fits.size(); ++b) compare(parts.fits[a], parts.fits[b], parts.warnings);
  }
  for (const PartFit& a : parts.fits) {
    for (const PartFit& b : parts.fits) {
      const bool turns = a.part.rfind("turns", 0) == 0;
      if (turns && b.part == "curves" && a.recording != b.recording) compare(a, b, parts.warnings);
    }
  }
  return parts;
}

}  // namespace umbsim::calibration
