#include "bench/worlds/checks/differences.h"

#include <cmath>
#include <map>
#include <stdexcept>
#include <tuple>

#include "core/random.h"

namespace umbsim::worlds {
namespace {

constexpr double kSpeeds_mps[] = {0.2, 0.6};
constexpr double kPayloads[] = {0, 0.3};
constexpr double kSide_m = 1.5;
constexpr double kArc_m = 0.4;

CheckDrive square(const Rig& rig, double speed_mps, const char* turn, Direction direction) {
  CheckDrive d;
  d.course.side_m = kSide_m;
  d.course.turn = turn;
  d.course.turn_radius_m = kArc_m;
  d.course.linear_speed_mps = speed_mps;
  d.course.angular_speed_radps = 2 * speed_mps / rig.robot.wheelbase_m();  // wheels as fast as along a leg
  d.course.angular_acceleration_radps2 = 2 * d.course.linear_acceleration_mps2 / rig.robot.wheelbase_m();
  d.direction = direction;
  d.believed = believed_of(rig);
  return d;
}

std::vector<CheckDrive> drives(const Rig& rig, double speed_mps) {
  std::vector<CheckDrive> all;
  for (const Direction direction : {Direction::cw, Direction::ccw}) {
    for (const char* turn : {"in_place", "arc"}) all.push_back(square(rig, speed_mps, turn, direction));
    all.push_back(all.back());
    all.back().kind = CheckDrive::Kind::circle;
  }
  return all;
}

void add_drives(const EngineKind& kind, const EngineOptions& options, const Condition& c,
                std::vector<PartResidual>& all) {
  const double own_kg = plain_rig(c.size).robot.total_mass_kg();
  const Rig rig = plain_rig(c.size, c.payload_share * own_kg);
  for (const CheckDrive& d : drives(rig, c.speed_mps)) {
    const std::unique_ptr<Engine> engine = kind.build({rig, {}, 1}, options);
    const DrivenTrack track = drive(*engine, d);
    const std::vector<Pose2> residual = residuals(track, d.believed);
    for (std::size_t i = 0; i < residual.size(); ++i) {
      all.push_back({track.parts[i].name, c, track.parts[i].length_m, track.parts[i].angle_rad, residual[i]});
    }
  }
}

}  // namespace

std::vector<PartResidual> residuals_of(const EngineKind& kind, int draws, std::uint64_t seed, int& refused) {
  std::vector<PartResidual> all;
  refused = 0;
  for (int k = 0; k < draws; ++k) {
    RandomStream random(seed, "engine differences " + kind.name, std::uint64_t(k));
    const EngineOptions options = draw_options(kind, random);
    std::vector<PartResidual> of_draw;
    try {
      for (const Size size : kSizes) {
        for (const double speed_mps : kSpeeds_mps) {
          for (const double payload : kPayloads) add_drives(kind, options, {size, speed_mps, payload}, of_draw);
        }
      }
    } catch (const std::runtime_error&) {  // RunError, InputError
      ++refused;
      continue;
    }
    all.insert(all.end(), of_draw.begin(), of_draw.end());
  }
  return all;
}

// The mean of the squared difference of two independent draws is that of the means plus both variances.
Difference difference(const std::vector<PartResidual>& a, const std::vector<PartResidual>& b) {
  using Key = std::tuple<Size, double, double, std::string, double, double>;
  struct Moments {
    double n[2]{}, sum[2][4]{}, squares[2][4]{};
  };
  std::map<Key, Moments> parts;
  const auto add = [&](const std::vector<PartResidual>& all, std::size_t side) {
    for (const PartResidual& p : all) {
      Moments& m =
          parts[{p.condition.size, p.condition.speed_mps, p.condition.payload_share, p.part, p.length_m, p.angle_rad}];
      const double share = p.angle_rad == 0 ? 0 : p.residual.theta_rad / p.angle_rad;
      const double value[] = {p.residual.x_m, p.residual.y_m, p.residual.theta_rad, share};
      ++m.n[side];
      for (int i = 0; i < 4; ++i) {
        m.sum[side][i] += value[i];
        m.squares[side][i] += value[i] * value[i];
      }
    }
  };
  add(a, 0);
  add(b, 1);
  double total[4] = {0, 0, 0, 0}, count = 0;
  for (const auto& [key, m] : parts) {
    if (m.n[0] == 0 || m.n[1] == 0) continue;
    for (int i = 0; i < 4; ++i) {
      const double mean_a = m.sum[0][i] / m.n[0], mean_b = m.sum[1][i] / m.n[1];
      total[i] += m.squares[0][i] / m.n[0] + m.squares[1][i] / m.n[1] - 2 * mean_a * mean_b;
    }
    ++count;
  }
  const auto rms = [&](int i) { return count == 0 ? 0 : std::sqrt(std::max(0.0, total[i] / count)); };
  return {rms(0), rms(1), rms(2), rms(3)};
}

}  // namespace umbsim::worlds
