#include "gap/evidence/impulsive_residuals.h"

#include <tbb/parallel_for.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace umbsim::gap {
namespace {

const Eigen::Vector3d kImpulseSd(0.02, 0.02, 0.05);  // prior size: metres, metres, radians
constexpr double kLostSd_m = 0.003;
constexpr double kApart_m = 0.3;  // of a robot with a wheelbase of 0.36 m, between places that are told apart

// Runs in the order of how much each adds to what all show; those that speak against it are left out.
std::vector<std::size_t> most_shown(const std::vector<double>& by_run, double sum) {
  std::vector<std::size_t> order;
  for (std::size_t r = 0; r < by_run.size(); ++r) {
    if (by_run[r] * sum > 0) order.push_back(r);
  }
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return std::abs(by_run[a]) > std::abs(by_run[b]); });
  return order;
}

using Products = std::vector<TrackFilter::ImpulseProducts>;  // of each run

// The strongest moment of each run, best first.
std::vector<Impulse> moments_of(const Products& all) {
  std::vector<Impulse> moments;
  for (std::size_t r = 0; r < all.size(); ++r) {
    Impulse best;
    for (std::size_t k = 1; k < all[r].with_itself.size(); ++k) {
      Eigen::Matrix3d M = kImpulseSd.asDiagonal() * all[r].with_itself[k] * kImpulseSd.asDiagonal();
      M.diagonal().array() += 1;
      const Eigen::LLT<Eigen::Matrix3d> llt(M);
      const Eigen::Vector3d b = kImpulseSd.cwiseProduct(all[r].with_column[k]);
      const Eigen::Vector3d x = llt.solve(b);
      double gain = 0.5 * b.dot(x);
      for (int c = 0; c < 3; ++c) gain -= std::log(llt.matrixLLT()(c, c));
      if (k == 1 || gain > best.gain) best = {r, k, kImpulseSd.cwiseProduct(x), gain};
    }
    moments.push_back(best);
  }
  std::sort(moments.begin(), moments.end(), [](const Impulse& a, const Impulse& b) { return a.gain > b.gain; });
  return moments;
}

// What all passes of a place show together.
PlaceImpulse weighed(const PassedPlace& at, const Products& all, double wheelbase_m) {
  PlaceImpulse place{at.x_m, at.y_m, at.heading_rad, at.wheel, 0, int(at.passes.size()), 0, {}};
  double zy = 0;
  double zz = 0;
  std::vector<double> shown(all.size());
  for (const WheelPass& pass : at.passes) {
    const Eigen::Vector3d lost(-0.5, 0, (pass.wheel == 0 ? 1 : -1) / wheelbase_m);
    const double seen_here = lost.dot(all[pass.run].with_column[pass.sample]);
    zy += seen_here;
    shown[pass.run] += seen_here;
    zz += lost.dot(all[pass.run].with_itself[pass.sample] * lost);
  }
  const double M = 1 + kLostSd_m * kLostSd_m * zz;
  place.lost_m = kLostSd_m * kLostSd_m * zy / M;
  place.gain = 0.5 * kLostSd_m * kLostSd_m * zy * zy / M - 0.5 * std::log(M);
  place.shown_by = most_shown(shown, zy);
  return place;
}

}  // namespace

const std::vector<PassedPlace>& Model::passed_places() const {
  if (!passed_places_)
    passed_places_ = std::make_shared<const std::vector<PassedPlace>>(gap::passed_places(nominal_, stretches_));
  return *passed_places_;
}

Impulses find_impulses(const Model& model, const Fit& fit) {
  const std::vector<Eigen::VectorXd> left = model.left_over(fit);
  Products all(left.size());
  tbb::parallel_for(std::size_t(0), all.size(),
                    [&](std::size_t r) { all[r] = model.filter(r).impulse_products(left[r]); });
  Impulses impulses{moments_of(all), {}};
  // Several recordings need not be of one floor.
  if (model.campaign().several()) return impulses;

  const RecordedRobot& robot = model.recording().robot;
  std::vector<PlaceImpulse> places;
  for (const PassedPlace& at : model.passed_places()) places.push_back(weighed(at, all, robot.wheelbase_m));
  std::sort(places.begin(), places.end(), [](const PlaceImpulse& a, const PlaceImpulse& b) { return a.gain > b.gain; });
  for (const PlaceImpulse& p : places) {
    const bool near = std::any_of(impulses.places.begin(), impulses.places.end(), [&](const PlaceImpulse& q) {
      return std::hypot(p.x_m - q.x_m, p.y_m - q.y_m) < length_scale(robot) * kApart_m;
    });
    if (!near) impulses.places.push_back(p);
    if (impulses.places.size() == 5) break;
  }
  return impulses;
}

double strongest(const Impulses& impulses) {
  const double place = impulses.places.empty() ? 0 : impulses.places.front().gain;
  const double moment = impulses.moments.empty() ? 0 : impulses.moments.front().gain;
  return std::max({0.0, place, moment});
}

}  // namespace umbsim::gap
