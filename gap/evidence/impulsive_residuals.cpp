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

}  // namespace

Impulses find_impulses(const Model& model, const Fit& fit) {
  const Recording& recording = model.recording();
  const std::size_t runs = recording.runs.size();
  const std::vector<Eigen::VectorXd> left = model.left_over(fit);
  std::vector<TrackFilter::ImpulseProducts> all(runs);
  tbb::parallel_for(std::size_t(0), runs, [&](std::size_t r) { all[r] = model.filter(r).impulse_products(left[r]); });

  Impulses impulses;
  for (std::size_t r = 0; r < runs; ++r) {
    Impulse best;
    for (std::size_t k = 1; k < model.filter(r).samples(); ++k) {
      Eigen::Matrix3d M = kImpulseSd.asDiagonal() * all[r].with_itself[k] * kImpulseSd.asDiagonal();
      M.diagonal().array() += 1;
      const Eigen::LLT<Eigen::Matrix3d> llt(M);
      const Eigen::Vector3d b = kImpulseSd.cwiseProduct(all[r].with_column[k]);
      const Eigen::Vector3d x = llt.solve(b);
      double gain = 0.5 * b.dot(x);
      for (int c = 0; c < 3; ++c) gain -= std::log(llt.matrixLLT()(c, c));
      if (k == 1 || gain > best.gain) best = {r, k, kImpulseSd.cwiseProduct(x), gain};
    }
    impulses.moments.push_back(best);
  }
  std::sort(impulses.moments.begin(), impulses.moments.end(),
            [](const Impulse& a, const Impulse& b) { return a.gain > b.gain; });

  // Several recordings need not be of one floor.
  if (model.campaign().several()) return impulses;

  // Where the wheels were, once and for all.
  std::vector<std::array<std::vector<Pose2>, 2>> wheels(runs);
  std::vector<std::array<std::vector<double>, 2>> way_m(runs);
  std::vector<std::vector<bool>> straight;
  for (std::size_t r = 0; r < runs; ++r) straight.push_back(goes_straight(model, r));
  for (std::size_t r = 0; r < runs; ++r) {
    for (int w = 0; w < 2; ++w) {
      way_m[r][std::size_t(w)] = rolled_m(model, r, w);
      for (std::size_t k = 0; k < recording.runs[r].truth.size(); ++k) {
        // Where the tracker saw the robot; between end points, where the wheels believed to be.
        const bool tracked = model.campaign().of(r).truth_kind != "endpoints";
        const Pose2& X_WB = tracked ? recording.runs[r].truth[k].X_WB : model.nominal().tracks[r][k];
        wheels[r][std::size_t(w)].push_back(wheel_place(X_WB, w, recording.robot.wheelbase_m));
      }
    }
  }
  // Candidates for places: wheel tracks of the first run of every condition and direction, each spot once.
  const double b_m = recording.robot.wheelbase_m;
  const double scale = std::clamp(b_m / kWheelbase_m, 0.3, 2.0);
  std::vector<PlaceImpulse> places;
  std::vector<std::string> seen;
  std::set<std::pair<long, long>> spots;
  for (std::size_t r = 0; r < runs; ++r) {
    const std::string key = model.nominal().conditions[r] + recording.runs[r].direction;
    if (std::find(seen.begin(), seen.end(), key) != seen.end()) continue;
    seen.push_back(key);
    for (std::size_t k = 1; k < model.filter(r).samples(); k += kStride) {
      for (int w = 0; w < 2; ++w) {
        const Pose2& at = wheels[r][std::size_t(w)][k];
        const double spot_m = scale * kSpot_m;
        if (!spots.insert({std::lround(at.x_m / spot_m), std::lround(at.y_m / spot_m)}).second) continue;
        places.push_back({at.x_m, at.y_m, at.theta_rad, w, 0, 0, 0, {}});
      }
    }
  }
  tbb::parallel_for(std::size_t(0), places.size(), [&](std::size_t c) {
    PlaceImpulse& place = places[c];
    double zy = 0;
    double zz = 0;
    double nearest_leg = 1e300;
    std::vector<double> shown(runs);
    for (std::size_t r = 0; r < runs; ++r) {
      for (int w = 0; w < 2; ++w) {
        // Nearest approach of each pass, once each. A pass is over when the wheel has rolled on beyond its reach.
        const std::vector<double>& way = way_m[r][std::size_t(w)];
        const double reach_m = scale * kReach_m, reach2 = reach_m * reach_m;
        double nearest = reach2;
        std::size_t at = 0;
        const auto take = [&] {
          if (nearest >= reach2) return;
          const Eigen::Vector3d lost(-0.5, 0, (w == 0 ? 1 : -1) / b_m);
          const double seen_here = lost.dot(all[r].with_column[at]);
          zy += seen_here;
          shown[r] += seen_here;
          zz += lost.dot(all[r].with_itself[at] * lost);
          ++place.passes;
          // What lies across the path lies across that of a leg, where there is one: in a corner headings are many.
          if (straight[r][at] && nearest < nearest_leg) {
            nearest_leg = nearest;
            place.heading_rad = wheels[r][std::size_t(w)][at].theta_rad;
          }
          nearest = reach2;
        };
        for (std::size_t k = 1; k < model.filter(r).samples(); ++k) {
          const Pose2& p = wheels[r][std::size_t(w)][k];
          const double dx = p.x_m - place.x_m;
          const double dy = p.y_m - place.y_m;
          const double d = dx * dx + dy * dy;
          if (d < nearest) {
            nearest = d;
            at = k;
          } else if (way[k] - way[at] > 2 * reach_m) {
            take();
          }
        }
        take();
      }
    }
    const double M = 1 + kLostSd_m * kLostSd_m * zz;
    place.lost_m = kLostSd_m * kLostSd_m * zy / M;
    place.gain = 0.5 * kLostSd_m * kLostSd_m * zy * zy / M - 0.5 * std::log(M);
    place.shown_by = most_shown(shown, zy);
  });
  std::sort(places.begin(), places.end(), [](const PlaceImpulse& a, const PlaceImpulse& b) { return a.gain > b.gain; });
  for (const PlaceImpulse& p : places) {
    const bool near = std::any_of(impulses.places.begin(), impulses.places.end(), [&](const PlaceImpulse& q) {
      return std::hypot(p.x_m - q.x_m, p.y_m - q.y_m) < scale * kApart_m;
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
