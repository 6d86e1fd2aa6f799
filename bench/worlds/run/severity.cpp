#include "bench/worlds/run/severity.h"

#include <limits>
#include <stdexcept>

namespace umbsim::worlds {
namespace {

constexpr Signal kSignals[] = {Signal::odometry, Signal::motors};
constexpr double kFiner = 64;  // encoders of the drives without noise
constexpr double kGuideStep_s = 0.02, kGuideFineStep_s = 0.001;

// The tracker's noise alone: its clock, frame and marker are refitted in every diagnosis.
Recording noisy(const World& w, const DrivenWorld& driven, std::uint64_t seed) {
  TrackerChoice plain;
  plain.rate_hz = w.driver.rate_hz;
  plain.position_sd_m = w.tracker.position_sd_m;
  plain.heading_sd_rad = w.tracker.heading_sd_rad;
  Recording r = w.runs.recording;
  r.runs = driven.runs;
  for (std::size_t i = 0; i < r.runs.size(); ++i) {
    r.runs[i].truth = observe(driven.runs[i].truth, plain, {seed, "worlds noise floor", i});
    r.runs[i].truth.front().X_WB = driven.runs[i].truth.front().X_WB;
  }
  return r;
}

}  // namespace

World guide_of(const World& world) {
  World guide = world;
  guide.engine = &find_engine("ours");
  guide.options = {
      {{"step_s", kGuideStep_s}, {"fine_step_s", kGuideFineStep_s}, {"static_sink_m", 0.00012}, {"damping_ratio", 2}},
      {}};
  return guide;
}

WorldScale::WorldScale(const World& world, const World& guide, std::uint64_t seed) : world_(world), seed_(seed) {
  nominal_run_ = drive_world(world_, clean());
  const Recording nominal = record_exactly(world_, nominal_run_, kFiner);
  for (const Signal signal : kSignals) nominal_[std::size_t(signal)] = signal_track(nominal, signal);
  Drive rough{{}, world.noise, seed, 1};
  const DrivenWorld guide_nominal = world.engine == guide.engine ? nominal_run_ : drive_world(guide, clean());
  const Recording expected = record_exactly(guide, guide_nominal, kFiner);
  const Recording measured = noisy(guide, drive_world(guide, rough), seed);
  const SignalTrack without = signal_track(expected, Signal::odometry);
  noise_[0] = signal_size(signal_track(measured, Signal::odometry), &without);
  // Motors that follow exactly leave quantisation as the only noise of their signal.
  const SignalTrack motors = signal_track(expected, Signal::motors);
  noise_[1] = signal_size(signal_track(measured, Signal::motors), &motors);
  of_the_world_ = umbsim::severity(signal_size(nominal_[0], nullptr), noise_[0]);
}

Drive WorldScale::clean() const { return {{}, {}, seed_, kFiner}; }

WorldScale::Seen WorldScale::severity(const Faults& faults) const {
  Drive drive = clean();
  drive.faults = faults;
  Seen seen;
  try {
    const Recording r = record_exactly(world_, drive_world(world_, drive), kFiner);
    for (const Signal signal : kSignals) {
      const std::size_t i = std::size_t(signal);
      const double s = umbsim::severity(signal_size(signal_track(r, signal), &nominal_[i]), noise_[i]);
      if (s > seen.severity) seen = {s, signal};
    }
  } catch (const std::runtime_error&) {  // RunError, or InputError: it tips over, or is driven out of all bounds
    seen.severity = std::numeric_limits<double>::infinity();
  }
  return seen;
}

SignalTrack WorldScale::change(const Faults& faults, Signal signal) const {
  Drive drive = clean();
  drive.faults = faults;
  SignalTrack track = signal_track(record_exactly(world_, drive_world(world_, drive), kFiner), signal);
  const SignalTrack& nominal = nominal_[std::size_t(signal)];
  for (std::size_t run = 0; run < track.size(); ++run) {
    for (std::size_t k = 0; k < track[run].size(); ++k) {
      for (std::size_t i = 0; i < 3; ++i) track[run][k][i] -= nominal[run][k][i];
    }
  }
  return track;
}

}  // namespace umbsim::worlds
