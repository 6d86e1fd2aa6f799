#include "gap/evidence/impulsive_residuals.h"

#include <tbb/parallel_for.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <set>

namespace umbsim::gap {
namespace {

constexpr std::size_t kStride = 2;                   // truth samples between two candidates
const Eigen::Vector3d kImpulseSd(0.02, 0.02, 0.05);  // prior size: metres, metres, radians
constexpr double kLostSd_m = 0.003;
constexpr double kWheelbase_m = 0.36;  // of a robot to which these lengths belong; others in proportion:
constexpr double kSpot_m = 0.03;
constexpr double kReach_m = 0.05;  // half length of what lies across the path
constexpr double kApart_m = 0.3;   // between places that are told apart

// Wheel positions at each candidate of a run.
Pose2 wheel_place(const Pose2& X_WB, int wheel, double wheelbase_m) {
  return X_WB * Pose2{0, (wheel == 0 ? 0.5 : -0.5) * wheelbase_m, 0};
}

// Way that a wheel has rolled until each sample of a run's truth, as the counts say: it does not grow while a robot
// stands and a noisy tracker sees it here and there.
std::vector<double> rolled_m(const Model& model, std::size_t r, int wheel) {
  const std::vector<Pose2>& track = model.nominal().tracks[r];
  std::vector<double> way{0};
  for (std::size_t k = 1; k < track.size(); ++k) {
    const double b_m = model.recording().robot.wheelbase_m;
    const Pose2 a = wheel_place(track[k - 1], wheel, b_m), b = wheel_place(track[k], wheel, b_m);
    way.push_back(way.back() + std::hypot(b.x_m - a.x_m, b.y_m - a.y_m));
  }
  return way;
}

// Whether the robot goes straight, at each sample of a run's truth.
std::vector<bool> goes_straight(const Model& model, std::size_t r) {
  std::vector<bool> straight;
  for (const TruthSample& sample : model.recording().runs[r].truth) {
    const auto& all = model.stretches(r);
    straight.push_back(std::any_of(all.begin(), all.end(), [&](const Stretch& s) {
      return s.kind == Stretch::Kind::leg && s.start_s <= sample.time_s && sample.time_s <= s.end_s;
    }));
  }
  return straight;
}

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

// Where the wheels of each run were, and how far they had rolled.
struct Wheels {
  std::vector<std::array<std::vector<Pose2>, 2>> at;
  std::vector<std::array<std::vector<double>, 2>> rolled_m;
  std::vector<std::vector<bool>> straight;
};

Wheels wheels_of(const Model& model) {
  const Recording& recording = model.recording();
  Wheels wheels{decltype(Wheels::at)(recording.runs.size()), decltype(Wheels::rolled_m)(recording.runs.size()), {}};
  for (std::size_t r = 0; r < recording.runs.size(); ++r) {
    wheels.straight.push_back(goes_straight(model, r));
    // Where the tracker saw the robot; between end points, where the wheels believed to be.
    const bool tracked = model.campaign().of(r).truth_kind != "endpoints";
    for (int w = 0; w < 2; ++w) {
      wheels.rolled_m[r][std::size_t(w)] = rolled_m(model, r, w);
      for (std::size_t k = 0; k < recording.runs[r].truth.size(); ++k) {
        const Pose2& X_WB = tracked ? recording.runs[r].truth[k].X_WB : model.nominal().tracks[r][k];
        wheels.at[r][std::size_t(w)].push_back(wheel_place(X_WB, w, recording.robot.wheelbase_m));
      }
    }
  }
  return wheels;
}

// Of the robot's size.
double length_scale(const Model& model) {
  return std::clamp(model.recording().robot.wheelbase_m / kWheelbase_m, 0.3, 2.0);
}

// Wheel tracks of the first run of every condition and direction, each spot once.
std::vector<PlaceImpulse> candidates(const Model& model, const Wheels& wheels) {
  const Recording& recording = model.recording();
  const double spot_m = length_scale(model) * kSpot_m;
  std::vector<PlaceImpulse> places;
  std::vector<std::string> seen;
  std::set<std::pair<long, long>> spots;
  for (std::size_t r = 0; r < recording.runs.size(); ++r) {
    const std::string key = model.nominal().conditions[r] + recording.runs[r].direction;
    if (std::find(seen.begin(), seen.end(), key) != seen.end()) continue;
    seen.push_back(key);
    for (std::size_t k = 1; k < model.filter(r).samples(); k += kStride) {
      for (int w = 0; w < 2; ++w) {
        const Pose2& at = wheels.at[r][std::size_t(w)][k];
        if (!spots.insert({std::lround(at.x_m / spot_m), std::lround(at.y_m / spot_m)}).second) continue;
        places.push_back({at.x_m, at.y_m, at.theta_rad, w, 0, 0, 0, {}});
      }
    }
  }
  return places;
}

// The nearest approach of a wheel that comes by a place.
struct Pass {
  std::size_t sample = 0;
  double apart_m2 = 0;
};

// Those of one wheel in a run. A pass is over when the wheel has rolled on beyond its reach.
std::vector<Pass> passes_of(const PlaceImpulse& place, const std::vector<Pose2>& wheel,
                            const std::vector<double>& rolled_m, double reach_m) {
  std::vector<Pass> passes;
  const Pass none{0, reach_m * reach_m};
  Pass nearest = none;
  const auto take = [&] {
    if (nearest.apart_m2 < none.apart_m2) passes.push_back(nearest);
    nearest.apart_m2 = none.apart_m2;
  };
  for (std::size_t k = 1; k < wheel.size(); ++k) {
    const double dx = wheel[k].x_m - place.x_m;
    const double dy = wheel[k].y_m - place.y_m;
    const double d = dx * dx + dy * dy;
    if (d < nearest.apart_m2)
      nearest = {k, d};
    else if (rolled_m[k] - rolled_m[nearest.sample] > 2 * reach_m)
      take();
  }
  take();
  return passes;
}

// What all passes of a place show together.
void weigh(const Model& model, const Products& all, const Wheels& wheels, PlaceImpulse& place) {
  const double b_m = model.recording().robot.wheelbase_m;
  double zy = 0;
  double zz = 0;
  double nearest_leg = 1e300;
  std::vector<double> shown(all.size());
  for (std::size_t r = 0; r < all.size(); ++r) {
    for (std::size_t w = 0; w < 2; ++w) {
      const double reach_m = length_scale(model) * kReach_m;
      const Eigen::Vector3d lost(-0.5, 0, (w == 0 ? 1 : -1) / b_m);
      for (const Pass& pass : passes_of(place, wheels.at[r][w], wheels.rolled_m[r][w], reach_m)) {
        const std::size_t at = pass.sample;
        const double seen_here = lost.dot(all[r].with_column[at]);
        zy += seen_here;
        shown[r] += seen_here;
        zz += lost.dot(all[r].with_itself[at] * lost);
        ++place.passes;
        // What lies across the path lies across that of a leg, where there is one: in a corner headings are many.
        if (!wheels.straight[r][at] || pass.apart_m2 >= nearest_leg) continue;
        nearest_leg = pass.apart_m2;
        place.heading_rad = wheels.at[r][w][at].theta_rad;
      }
    }
  }
  const double M = 1 + kLostSd_m * kLostSd_m * zz;
  place.lost_m = kLostSd_m * kLostSd_m * zy / M;
  place.gain = 0.5 * kLostSd_m * kLostSd_m * zy * zy / M - 0.5 * std::log(M);
  place.shown_by = most_shown(shown, zy);
}

}  // namespace

Impulses find_impulses(const Model& model, const Fit& fit) {
  const std::vector<Eigen::VectorXd> left = model.left_over(fit);
  Products all(left.size());
  tbb::parallel_for(std::size_t(0), all.size(),
                    [&](std::size_t r) { all[r] = model.filter(r).impulse_products(left[r]); });
  Impulses impulses{moments_of(all), {}};
  // Several recordings need not be of one floor.
  if (model.campaign().several()) return impulses;

  const Wheels wheels = wheels_of(model);
  std::vector<PlaceImpulse> places = candidates(model, wheels);
  tbb::parallel_for(std::size_t(0), places.size(), [&](std::size_t c) { weigh(model, all, wheels, places[c]); });
  std::sort(places.begin(), places.end(), [](const PlaceImpulse& a, const PlaceImpulse& b) { return a.gain > b.gain; });
  for (const PlaceImpulse& p : places) {
    const bool near = std::any_of(impulses.places.begin(), impulses.places.end(), [&](const PlaceImpulse& q) {
      return std::hypot(p.x_m - q.x_m, p.y_m - q.y_m) < length_scale(model) * kApart_m;
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
