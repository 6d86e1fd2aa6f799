#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <vector>

#include "core/pose2.h"
#include "core/recent.h"
#include "effects/rig.h"
#include "experiment/replay/even_stretches.h"
#include "recording/recording.h"
#include "sim/snapshot.h"
#include "sim/world.h"

namespace umbsim {

/// A recorded run as it is driven again: where from, the speeds of both shafts at each of the encoders' samples, and
/// how rough the floor is under the wheels on the way there.
struct ShaftDrive {
  const std::vector<EncoderSample>& samples;
  std::vector<double> left_radps;
  std::vector<double> right_radps;
  Pose2 start;
  std::shared_ptr<const EvenStretches> stretches{};
  std::vector<std::array<double, 2>> rolling{};  ///< rolling radii over the wheels' own; empty: they are their own

  double period_s(std::size_t sample) const { return samples[sample].time_s - samples[sample - 1].time_s; }
  /// From the sample before to this one.
  void advance(World& world, std::size_t sample) const {
    for (int i = 0; i < 2 && !rolling.empty(); ++i) world.scale_rolling_radius(i, rolling[sample][std::size_t(i)]);
    world.command(left_radps[sample], right_radps[sample]);
    world.advance(period_s(sample));
  }
};

/// The poses at the samples. The robot goes through each even stretch in one step as long as it only rolls, elsewhere
/// from sample to sample. Throws RunError, InputError.
std::vector<Pose2> rolled(World& world, const ShaftDrive& drive);

/// A run that was driven once: the poses at all samples, and the moments at some of them.
struct TracedRun {
  static constexpr std::size_t kEvery = 10;  ///< samples from one moment to the next
  ShaftDrive drive;
  std::vector<Pose2> track;
  std::vector<Snapshot> moments;
  std::vector<Pose2> seen;  ///< of each moment, seen_track.h; empty: the robot was where the track says
};

/// Without `moments` the poses alone. Throws RunError, InputError.
TracedRun traced(World& world, ShaftDrive drive, bool moments = true);

/// Whether the floor is the same at each place and in each direction but for what lies there: cables and patches.
bool same_everywhere(const Floor& floor);

/// The poses at the samples of the same drive in a world of `rig` and `pushes`, which differs from that of `without` by
/// cables, patches and pushes alone, on a floor that is the same everywhere. Only what happens near these is driven:
/// else the run goes as it went without them, carried to where the robot now is, once it goes on alike
/// (sim/snapshot.h). The robot meets them where it was seen: what they do to it is carried back to the track. Throws
/// RunError, InputError.
std::vector<Pose2> driven_near(World& world, const Rig& rig, const std::vector<Push>& pushes, const TracedRun& without);

/// Runs that were traced last.
using Traces = Recent<std::shared_ptr<const TracedRun>>;
constexpr std::size_t kTracesKept = 64;  ///< some 50 MB

}  // namespace umbsim
