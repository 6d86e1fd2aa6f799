#include "experiment/replay/traced_run.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace umbsim {
namespace {

constexpr double kMargin_m = 0.05;  // beyond where anything is felt
constexpr double kMargin_s = 0.05;  // the same of a push

// Discs outside of which nothing that lies on the floor is felt by a robot whose axle's middle is there.
struct Disc {
  double x_m;
  double y_m;
  double radius_m;
};

double furthest_support_m(const RobotModel& robot) {
  double most = 0;
  for (const Wheel& w : robot.wheels) most = std::max(most, w.centre_m.head<2>().norm());
  for (const Caster& c : robot.casters) {
    const double swing = (c.centre_m - c.swivel_point_m).head<2>().norm();
    most = std::max(most, c.swivels ? c.swivel_point_m.head<2>().norm() + swing : c.centre_m.head<2>().norm());
  }
  return most;
}

double largest_radius_m(const RobotModel& robot) {
  double most = std::max(robot.wheels[0].radius_m, robot.wheels[1].radius_m);
  for (const Caster& c : robot.casters) most = std::max(most, c.radius_m);
  return most;
}

class Happenings {
 public:
  Happenings(const Rig& rig, const std::vector<Push>& pushes) : pushes_(pushes) {
    const double reach = furthest_support_m(rig.robot) + kMargin_m;
    for (const FrictionPatch& p : rig.floor.patches) discs_.push_back({p.x_m, p.y_m, p.radius_m + reach});
    for (const Cable& c : rig.floor.cables) {
      // A wheel meets a cable at most this far from its middle line.
      const double climb = std::sqrt(2 * largest_radius_m(rig.robot) * c.height_m) + c.height_m;
      discs_.push_back({c.x_m, c.y_m, c.length_m / 2 + climb + reach});
    }
  }

  bool near(const Pose2& pose) const {
    return std::any_of(discs_.begin(), discs_.end(), [&](const Disc& d) {
      const double dx = pose.x_m - d.x_m, dy = pose.y_m - d.y_m;
      return dx * dx + dy * dy < d.radius_m * d.radius_m;
    });
  }

  bool pushed(double from_s, double to_s) const {
    return std::any_of(pushes_.begin(), pushes_.end(),
                       [&](const Push& p) { return from_s < p.time_s + p.duration_s && to_s > p.time_s; });
  }

 private:
  const std::vector<Push>& pushes_;
  std::vector<Disc> discs_;
};

}  // namespace

// In one step a robot rolls as if its wheels had turned evenly: what that leaves out is kinematics, and dead reckoning
// knows it. What the robot does beside dead reckoning is spread over the samples.
std::vector<Pose2> rolled(World& world, const ShaftDrive& drive) {
  const std::vector<EncoderSample>& s = drive.samples;
  world.place(drive.start);
  std::vector<Pose2> track{world.pose()};
  track.reserve(s.size());
  Pose2 off;  // of the robot from where the world has it
  bool slides = false;
  for (const EvenStretch& stretch : *drive.stretches) {
    const std::size_t from = track.size() - 1, to = stretch.end;
    const double all_s = s[to].time_s - s[from].time_s;
    const Pose2 before = world.pose();
    const auto& [left_rad, right_rad] = stretch.turned_rad;
    world.command(drive.left_radps[to], drive.right_radps[to]);
    if (to - from > 1 && !slides && world.roll({left_rad / all_s, right_rad / all_s}, all_s, stretch.peak_mps2)) {
      const Pose2 start = track.back();
      const Pose2 beside = inverse(stretch.as_one_arc) * (inverse(before) * world.pose());
      for (std::size_t i = from + 1; i <= to; ++i) {
        const double share = (s[i].time_s - s[from].time_s) / all_s;
        const Pose2 part{share * beside.x_m, share * beside.y_m, share * beside.theta_rad};
        track.push_back(start * stretch.sample_by_sample[i - from - 1] * part);
      }
      off = track.back() * inverse(world.pose());
      continue;
    }
    for (std::size_t i = from + 1; i <= to; ++i) {
      drive.advance(world, i);
      track.push_back(off * world.pose());
    }
    slides = world.slides();
  }
  return track;
}

TracedRun traced(World& world, ShaftDrive shafts, bool moments) {
  TracedRun run{std::move(shafts), {}, {}, {}};
  const ShaftDrive& drive = run.drive;
  run.track.reserve(drive.samples.size());
  world.place(drive.start);
  for (std::size_t i = 0; i < drive.samples.size(); ++i) {
    if (i > 0) drive.advance(world, i);
    run.track.push_back(world.pose());
    if (moments && i % TracedRun::kEvery == 0) run.moments.push_back(world.snapshot());
  }
  return run;
}

bool same_everywhere(const Floor& floor) {
  return floor.ripples.empty() && floor.slope_rad == 0 && floor.drift_x == 0 && floor.drift_y == 0;
}

std::vector<Pose2> driven_near(World& world, const Rig& rig, const std::vector<Push>& pushes,
                               const TracedRun& without) {
  const ShaftDrive& drive = without.drive;
  constexpr std::size_t kEvery = TracedRun::kEvery;
  const Happenings happenings(rig, pushes);
  const std::size_t samples = drive.samples.size();
  const auto time_s = [&](std::size_t i) { return drive.samples[i].time_s - drive.samples.front().time_s; };
  std::vector<Pose2> track;
  track.reserve(samples);
  Pose2 moved;  // to where the robot is now from where it was without
  const auto there = [&](std::size_t i) { return without.seen.empty() ? moved : without.seen[i / kEvery]; };
  // Something happens from here to the next sample.
  const auto happens = [&](std::size_t i) {
    return happenings.near(there(i) * without.track[i]) ||
           (i + 1 < samples && happenings.near(there(i) * without.track[i + 1])) ||
           (i + 1 < samples && happenings.pushed(time_s(i) - kMargin_s, time_s(i + 1) + kMargin_s));
  };
  while (track.size() < samples) {
    std::size_t next = track.size();
    while (next < samples && !happens(next)) ++next;
    for (std::size_t i = track.size(); i < next; ++i) track.push_back(moved * without.track[i]);
    if (next == samples) break;
    const std::size_t from = next / kEvery * kEvery;
    const Pose2 back = moved * inverse(there(from));
    if (from == 0) {
      world.place(there(0) * drive.start);
    } else {
      world.resume(without.moments[from / kEvery], there(from));
    }
    track.resize(from);
    track.push_back(back * world.pose());
    bool over = false;
    for (std::size_t i = from + 1; i < samples && !over; ++i) {
      drive.advance(world, i);
      track.push_back(back * world.pose());
      if (i % kEvery != 0 || happenings.near(world.pose())) continue;
      const bool still = happenings.pushed(time_s(i - 1), time_s(i) + kMargin_s);
      over = !still && goes_on_alike(world.snapshot(), without.moments[i / kEvery]);
      if (over) moved = track.back() * inverse(without.track[i]);
    }
  }
  return track;
}

}  // namespace umbsim
