#include "gap/evidence/floor_shifts.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <array>
#include <cmath>

namespace umbsim::gap {
namespace {

constexpr double kEnds_m = 0.25;   // of a leg, which turns touch
constexpr double kWindow_m = 1.0;  // either way: what bends more slowly is no shift of a place

// What remains of a leg's track errors when a straight line through the neighbourhood is taken out.
void detrend(std::vector<Shifted>& leg, const std::vector<double>& way_m, std::vector<Shifted>& into) {
  for (std::size_t k = 0; k < leg.size(); ++k) {
    double n = 0, s = 0, ss = 0;
    Eigen::Vector2d f = Eigen::Vector2d::Zero(), sf = f;
    for (std::size_t j = 0; j < leg.size(); ++j) {
      const double d = way_m[j] - way_m[k];
      if (std::abs(d) > kWindow_m) continue;
      n += 1;
      s += d;
      ss += d * d;
      f += leg[j].shift_m;
      sf += d * leg[j].shift_m;
    }
    const double det = n * ss - s * s;
    if (n < 8 || det <= 0) continue;
    into.push_back(leg[k]);
    Shifted& shifted = into.back();
    shifted.shift_m -= (ss * f - s * sf) / det;
    // Two passes matched by where a tracker saw them would be matched by its noise: alike where both strayed alike.
    shifted.X_WB.x_m -= shifted.shift_m.x();
    shifted.X_WB.y_m -= shifted.shift_m.y();
  }
}

}  // namespace

void without_ripples(std::vector<Shifted>& run) {
  Eigen::Matrix4d A = 1e-9 * Eigen::Matrix4d::Identity();
  Eigen::Matrix<double, 4, 2> b = Eigen::Matrix<double, 4, 2>::Zero();
  const auto turned = [](const Shifted& s, double way) {
    return Eigen::Vector2d(Eigen::Rotation2Dd(way * s.X_WB.theta_rad) * s.shift_m);
  };
  for (const Shifted& s : run) {
    A += s.wheels * s.wheels.transpose();
    b += s.wheels * turned(s, -1).transpose();
  }
  const Eigen::Matrix<double, 4, 2> x = A.ldlt().solve(b);
  for (Shifted& s : run) {
    s.shift_m -= Eigen::Rotation2Dd(s.X_WB.theta_rad) * Eigen::Vector2d(x.transpose() * s.wheels);
  }
}

std::vector<Shifted> shifts_of(const Model& model, const Fit& fit, std::size_t r) {
  const auto& truth = model.recording().runs[r].truth;
  const Eigen::VectorXd error = track_error(fit.predicted.tracks[r], model.nominal().truth[r]);
  std::vector<Shifted> result;
  std::vector<Eigen::Vector4d> wheels(1, Eigen::Vector4d(1, 1, 0, 0));
  std::array<double, 2> angle{};
  for (std::size_t k = 1; k < truth.size(); ++k) {
    for (std::size_t w = 0; w < 2; ++w)
      angle[w] += model.nominal().wheels_m[r][k][w] / model.recording().robot.wheel_radius_m;
    wheels.emplace_back(std::cos(angle[0]), std::cos(angle[1]), std::sin(angle[0]), std::sin(angle[1]));
  }
  for (const Stretch& s : model.stretches(r)) {
    if (s.kind != Stretch::Kind::leg) continue;
    std::vector<Shifted> leg;
    std::vector<double> way_m;
    double way = 0;
    for (std::size_t k = 1; k < truth.size(); ++k) {
      if (truth[k].time_s <= s.start_s || truth[k].time_s >= s.end_s) continue;
      way += model.nominal().rolled_m[r][k];
      if (way < kEnds_m || way > std::abs(s.length_m) - kEnds_m) continue;
      const double c = std::cos(truth[k].X_WB.theta_rad), sn = std::sin(truth[k].X_WB.theta_rad);
      const double along = error[3 * Eigen::Index(k)], across = error[3 * Eigen::Index(k) + 1];
      leg.push_back({truth[k].X_WB, {c * along - sn * across, sn * along + c * across}, s.leg, wheels[k]});
      way_m.push_back(way);
    }
    detrend(leg, way_m, result);
  }
  return result;
}

Passes::Spot Passes::spot_of(const Pose2& p) {
  return {std::lround(p.x_m / kSamePlace_m), std::lround(p.y_m / kSamePlace_m)};
}

Passes::Passes(std::vector<Shifted> all) : all_(std::move(all)) {
  for (std::size_t i = 0; i < all_.size(); ++i) at_[spot_of(all_[i].X_WB)].push_back(i);
}

const Shifted* Passes::nearest(const Pose2& p) const {
  const Spot spot = spot_of(p);
  const Shifted* best = nullptr;
  double least = kSamePlace_m * kSamePlace_m;
  for (long i = -1; i <= 1; ++i) {
    for (long j = -1; j <= 1; ++j) {
      const auto found = at_.find({spot.first + i, spot.second + j});
      if (found == at_.end()) continue;
      for (const std::size_t k : found->second) {
        const double d = std::pow(all_[k].X_WB.x_m - p.x_m, 2) + std::pow(all_[k].X_WB.y_m - p.y_m, 2);
        if (d >= least) continue;
        least = d;
        best = &all_[k];
      }
    }
  }
  return best;
}

}  // namespace umbsim::gap
