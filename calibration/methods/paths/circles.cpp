#include "calibration/methods/paths/circles.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <complex>

#include "calibration/methods/paths/pieces.h"

namespace umbsim::calibration {
namespace {

constexpr double kTrimmed = 0.1;       // of the arc at either end: speeding up and slowing down
constexpr double kLeastArc_rad = 1;    // shorter arcs do not tell a circle's radius
constexpr double kBlock_s = 1;         // over which the wheels' ways are compared
constexpr double kSteady = 0.05;       // by which the bend of one arc may vary
constexpr double kStraight = 0.01;     // bend below which a path counts as straight
constexpr double kLeastRadius = 0.25;  // of the wheelbase: less is turning in place
constexpr double kBend = 0.005;        // of the radius, by which positions may leave the circle without a word

// One steady arc: the wheels' ways by nominal radii, the circle as tracked (psi signed as driven).
struct Arc {
  double left_m = 0, right_m = 0;
  double turned_rad = 0;
  double radius_m = 0;  ///< 0: not known
  double bend = 0;      ///< rms distance of the positions from the circle, over its radius
};

// Least squares of x^2 + y^2 = 2 a x + 2 b y + c (Kasa 1976) about the positions' middle.
Eigen::Vector3d circle_through(const std::vector<TruthSample>& truth, std::size_t from, std::size_t to) {
  Eigen::MatrixXd A(to - from, 3);
  Eigen::VectorXd y(to - from);
  const Pose2& o = truth[from].X_WB;
  for (std::size_t k = from; k < to; ++k) {
    const double dx = truth[k].X_WB.x_m - o.x_m, dy = truth[k].X_WB.y_m - o.y_m;
    A.row(Eigen::Index(k - from)) << 2 * dx, 2 * dy, 1;
    y[Eigen::Index(k - from)] = dx * dx + dy * dy;
  }
  const Eigen::Vector3d x = A.colPivHouseholderQr().solve(y);
  return {o.x_m + x[0], o.y_m + x[1], std::sqrt(std::max(0.0, x[2] + x[0] * x[0] + x[1] * x[1]))};
}

// Where the run curves with one ratio of the wheels' ways: first and last encoder sample of each such arc.
std::vector<std::pair<std::size_t, std::size_t>> steady_arcs(const RecordedRun& run, double wheelbase_in_ticks) {
  const std::vector<EncoderSample>& s = run.encoders;
  std::vector<std::pair<std::size_t, std::size_t>> arcs;
  std::size_t first = 0;
  double bend = 0;  // of the arc so far: (right - left) / (right + left)
  const auto close = [&](std::size_t last) {
    const double turned = double(s[last].right_ticks - s[first].right_ticks - s[last].left_ticks + s[first].left_ticks);
    if (std::abs(turned) > kLeastArc_rad * wheelbase_in_ticks && std::abs(bend) * kLeastRadius < 0.5)
      arcs.emplace_back(first, last);
    first = last;
    bend = 0;
  };
  for (std::size_t from = 0, to = 1; to < s.size(); ++to) {
    if (s[to].time_s - s[from].time_s < kBlock_s) continue;
    const double left = double(s[to].left_ticks - s[from].left_ticks);
    const double right = double(s[to].right_ticks - s[from].right_ticks);
    const double now = left + right == 0 ? 0 : (right - left) / (right + left);
    if (bend == 0 ? std::abs(now) < kStraight : std::abs(now / bend - 1) > kSteady) close(from);
    if (std::abs(now) < kStraight) close(to);
    if (bend == 0 && std::abs(now) >= kStraight) bend = now;
    from = to;
  }
  close(s.size() - 1);
  return arcs;
}

Arc tracked_arc(const TrainingRun& r, const OdometryParameters& nominal, double from_s, double to_s) {
  Arc arc;
  const double trim_s = kTrimmed * (to_s - from_s);
  const std::vector<TruthSample>& truth = r.run->truth;
  std::size_t from = 0, to = truth.size();
  while (from < to && truth[from].time_s < from_s + trim_s) ++from;
  while (to > from && truth[to - 1].time_s > to_s - trim_s) --to;
  if (to - from < 10) return arc;
  const std::vector<Travel> at = travel(*r.run, nominal, {truth[from].time_s, truth[to - 1].time_s});
  arc.left_m = at[1].left_m - at[0].left_m;
  arc.right_m = at[1].right_m - at[0].right_m;
  const Eigen::Vector3d c = circle_through(truth, from, to);
  std::complex<double> last(0, 0);
  for (std::size_t k = from; k < to; ++k) {
    const std::complex<double> now(truth[k].X_WB.x_m - c[0], truth[k].X_WB.y_m - c[1]);
    if (k > from) arc.turned_rad += std::arg(now / last);
    arc.bend += std::pow(std::abs(now) / c[2] - 1, 2) / double(to - from);
    last = now;
  }
  arc.bend = std::sqrt(arc.bend);
  if (std::abs(arc.turned_rad) > kLeastArc_rad / 2) arc.radius_m = c[2];
  return arc;
}

std::vector<Arc> tracked_arcs(const TrainingRun& r, const OdometryParameters& nominal) {
  std::vector<Arc> arcs;
  const double ticks = nominal.wheelbase_m / (nominal.left_metres_per_tick() + nominal.right_metres_per_tick()) * 2;
  for (const auto& [first, last] : steady_arcs(*r.run, ticks)) {
    const Arc arc = tracked_arc(r, nominal, r.run->encoders[first].time_s, r.run->encoders[last].time_s);
    if (arc.radius_m > 0) arcs.push_back(arc);
  }
  return arcs;
}

Arc counted_arc(const TrainingRun& r, const OdometryParameters& nominal) {
  const Runs one{r};
  const Piece p = CutRuns(one, nominal, 1).pieces(nominal).front();
  return {p.counted.left_m, p.counted.right_m, p.tracked.theta_rad, 0, 0};
}

}  // namespace

Fit fit_circles(const Runs& runs, const OdometryParameters& nominal) {
  Eigen::MatrixXd rows(0, 3);
  Eigen::VectorXd right(0);
  const auto add = [&](double weight, double left, double rgt, double b, double y) {
    rows.conservativeResize(rows.rows() + 1, 3);
    right.conservativeResize(rows.rows());
    rows.row(rows.rows() - 1) << left, rgt, b;
    rows.row(rows.rows() - 1) *= std::sqrt(weight);
    right[rows.rows() - 1] = std::sqrt(weight) * y;
  };
  Fit fit;
  int lefts = 0, rights = 0;
  std::size_t used = 0;
  double worst_bend = 0;
  for (const TrainingRun& r : runs) {
    const bool eight = r.shape() == "figure_eight" && r.tracked();  // its ends say nothing of either circle
    if (r.shape() != "circle" && !eight) continue;
    ++used;
    for (const Arc& arc : r.tracked() ? tracked_arcs(r, nominal) : std::vector<Arc>{counted_arc(r, nominal)}) {
      (arc.turned_rad > 0 ? lefts : rights) += 1;
      add(r.weight, -arc.left_m, arc.right_m, -nominal.wheelbase_m * arc.turned_rad, 0);
      if (arc.radius_m == 0) continue;
      add(r.weight, arc.left_m / 2, arc.right_m / 2, 0,
          arc.radius_m * std::abs(arc.turned_rad) * (arc.left_m + arc.right_m < 0 ? -1 : 1));
      fit.scale_observed = true;
      worst_bend = std::max(worst_bend, arc.bend);
    }
  }
  if (lefts + rights == 0)
    throw NotApplicable("needs circles (path.shape: circle or figure_eight) of a radian or more; there is none here");
  if (lefts == 0 || rights == 0)
    throw NotApplicable("needs circles of both directions: in one, unequal wheels and a wrong wheelbase look alike");
  if (!fit.scale_observed) add(1, 1, 1, 0, 2);  // the mean radius stays
  const Eigen::Matrix3d normal = rows.transpose() * rows;
  const Eigen::Vector3d x = normal.ldlt().solve(rows.transpose() * right);
  fit.factors = x.array().log();
  fit.condition = condition_number(normal);
  if (worst_bend > kBend) {
    fit.warnings.push_back(
        fmt::format("a circle is none: its positions leave it by {:.1f} % of the radius", 100 * worst_bend));
  }
  if (used < runs.size()) fit.warnings.push_back(fmt::format("uses circles only: {} of {} runs", used, runs.size()));
  return fit;
}

}  // namespace umbsim::calibration
