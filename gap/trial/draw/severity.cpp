#include "gap/trial/draw/severity.h"

#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>

#include "core/error.h"
#include "odometry/dead_reckoning.h"

namespace umbsim {
namespace {

constexpr Signal kSignals[] = {Signal::odometry, Signal::motors};
constexpr int kMoments = 120;    // of a run, beside its start: every tenth of a metre or so
constexpr int kNoiseDrives = 2;  // of the whole set of runs
constexpr double kFiner = 64;    // encoders of the drives without noise: quantisation is noise
constexpr double kNear = 0.1;  // severity may miss the drawn one by 10 %: the answers hold the one it has
constexpr std::uintmax_t kMaxSteps = 8;  // simulations of a whole set of runs

// The pose that wheel angles lead to, from the origin.
class WheelPath {
 public:
  WheelPath(double radius_m, double wheelbase_m) : radius_m_(radius_m), wheelbase_m_(wheelbase_m) {}
  void turn(double left_rad, double right_rad) {
    pose = pose * arc((left_rad + right_rad) / 2 * radius_m_, (right_rad - left_rad) * radius_m_ / wheelbase_m_);
  }
  Pose2 pose;

 private:
  double radius_m_;
  double wheelbase_m_;
};

// Poses by ticks and by commands at every row of encoders.csv, in the frame of the run's start.
struct WheelPaths {
  std::vector<Pose2> ticks;
  std::vector<Pose2> commands;
};

WheelPaths wheel_paths(const RecordedRobot& robot, const RecordedRun& run) {
  const double rad_per_tick = 2 * M_PI / robot.ticks_per_revolution;
  WheelPath ticks(robot.wheel_radius_m, robot.wheelbase_m), commands = ticks;
  WheelPaths paths{{ticks.pose}, {commands.pose}};
  for (std::size_t i = 1; i < run.encoders.size(); ++i) {
    const EncoderSample& a = run.encoders[i - 1];
    const EncoderSample& b = run.encoders[i];
    const double dt = b.time_s - a.time_s;
    ticks.turn(double(b.left_ticks - a.left_ticks) * rad_per_tick,
               double(b.right_ticks - a.right_ticks) * rad_per_tick);
    // Set-points ramp from one command to the next (docs/life-of-a-run.md).
    commands.turn((a.left_command_radps + b.left_command_radps) / 2 * dt,
                  (a.right_command_radps + b.right_command_radps) / 2 * dt);
    paths.ticks.push_back(ticks.pose);
    paths.commands.push_back(commands.pose);
  }
  return paths;
}

std::array<double, 3> difference(const Pose2& a, const Pose2& b) {
  return {a.x_m - b.x_m, a.y_m - b.y_m, a.theta_rad - b.theta_rad};
}

// The row of encoders.csv nearest to a time.
std::size_t row_at(const RecordedRun& run, double time_s, double rate_hz) {
  const auto row = std::lower_bound(run.encoders.begin(), run.encoders.end(), time_s - 0.5 / rate_hz,
                                    [](const EncoderSample& e, double t) { return e.time_s < t; });
  return std::min(std::size_t(row - run.encoders.begin()), run.encoders.size() - 1);
}

std::vector<std::array<double, 3>> run_track(const Recording& recording, const RecordedRun& run, Signal signal) {
  const WheelPaths paths = wheel_paths(recording.robot, run);
  const Pose2 X_SW = inverse(run.truth.front().X_WB);
  const int moments = recording.truth_kind == "endpoints" ? 1 : kMoments;
  std::vector<std::array<double, 3>> track;
  for (int k = 1; k <= moments; ++k) {
    const std::size_t row = (run.truth.size() - 1) * std::size_t(k) / std::size_t(moments);
    const TruthSample& truth = run.truth[row];
    const std::size_t at = row_at(run, truth.time_s, recording.encoder_rate_hz);
    track.push_back(signal == Signal::odometry ? difference(X_SW * truth.X_WB, paths.ticks[at])
                                               : difference(paths.ticks[at], paths.commands[at]));
  }
  return track;
}

// Root mean square over the components that have noise.
double ratio(const std::array<double, 3>& change, const std::array<double, 3>& noise) {
  double sum = 0, count = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    if (noise[c] == 0) continue;
    sum += std::pow(change[c] / noise[c], 2);
    ++count;
  }
  return count == 0 ? 0 : std::sqrt(sum / count);
}

// Looks for the amplitude of a severity and keeps the nearest that it has seen.
class AmplitudeSearch {
 public:
  AmplitudeSearch(const DrawnEffect& drawn, Signal signal, double wanted, double noise_level,
                  const SeverityScale& scale)
      : drawn_(drawn), signal_(signal), wanted_(wanted), noise_level_(noise_level), scale_(scale) {
    highest_ = wanted_ * std::exp(miss(std::log(drawn_.range.max)));
  }

  /// At the plausible maximum.
  double highest() const { return highest_; }

  /// The effect at the wanted severity, which must not be above the highest. `drawn`: to be noted.
  ScaledEffect solved(double drawn) {
    solve();
    return {drawn_.at(amplitude_), drawn, severity_, signal_, false};
  }

  /// Looks for another severity from now on.
  void want(double wanted) {
    wanted_ = wanted;
    severity_ = std::numeric_limits<double>::infinity();
    note(drawn_.range.max, highest_);
  }

 private:
  /// log(severity / wanted). Infinite severities (the robot cannot be driven) count as far too large.
  double miss(double log_amplitude) {
    const double s = std::clamp(scale_.severity(drawn_.at(std::exp(log_amplitude)), signal_) / noise_level_, 1e-9, 1e9);
    note(std::exp(log_amplitude), s);
    return std::log(s / wanted_);
  }

  void solve() {
    const double low = std::log(drawn_.range.min), high = std::log(drawn_.range.max);
    const double at_low = miss(low), at_high = std::log(highest_ / wanted_);
    if (at_low >= 0 || at_high <= kNear) return;  // one end is as near as any; the answers hold the severity it has
    std::uintmax_t steps = kMaxSteps;
    const auto near = [&](double log_amplitude) {
      const double m = miss(log_amplitude);
      return std::abs(m) < kNear ? 0.0 : m;
    };
    boost::math::tools::toms748_solve(near, low, high, at_low, at_high, boost::math::tools::eps_tolerance<double>(10),
                                      steps);
  }

  void note(double amplitude_seen, double severity_seen) {
    if (std::abs(std::log(severity_seen / wanted_)) >= std::abs(std::log(severity_ / wanted_))) return;
    severity_ = severity_seen;
    amplitude_ = amplitude_seen;
  }

  const DrawnEffect& drawn_;
  Signal signal_;
  double wanted_;
  double highest_ = 0;
  double noise_level_;
  const SeverityScale& scale_;
  double amplitude_ = 0;
  double severity_ = std::numeric_limits<double>::infinity();
};

// Where `value` lies in `range`, logarithmically, there in the range that ends at `highest`.
double same_place(double value, const Range& range, double highest) {
  const double lowest = std::min(range.min, highest);
  if (range.max == range.min) return highest;
  return lowest * std::pow(highest / lowest, std::log(value / range.min) / std::log(range.max / range.min));
}

}  // namespace

const char* name(Signal signal) {
  return signal == Signal::odometry ? "absolute pose against ticks" : "ticks against commands";
}

SignalTrack signal_track(const Recording& recording, Signal signal) {
  SignalTrack track;
  for (const RecordedRun& run : recording.runs) track.push_back(run_track(recording, run, signal));
  return track;
}

SignalSize signal_size(const SignalTrack& a, const SignalTrack* b) {
  SignalSize sum;
  double count = 0;
  for (std::size_t r = 0; r < a.size(); ++r) {
    std::array<double, 3> last{};  // at the start nothing differs
    for (std::size_t k = 0; k < a[r].size(); ++k) {
      for (std::size_t c = 0; c < 3; ++c) {
        const double d = a[r][k][c] - (b ? (*b)[r][k][c] : 0);
        sum.whole[c] += d * d;
        sum.steps[c] += (d - last[c]) * (d - last[c]);
        last[c] = d;
      }
      ++count;
    }
  }
  for (std::size_t c = 0; c < 3; ++c) {
    sum.whole[c] = std::sqrt(sum.whole[c] / count);
    sum.steps[c] = std::sqrt(sum.steps[c] / count);
  }
  return sum;
}

double severity(const SignalSize& change, const SignalSize& noise) {
  return std::max(ratio(change.whole, noise.whole), ratio(change.steps, noise.steps));
}

SeverityScale::SeverityScale(const TrialPlan& plan, const Platform& platform, Recording planned,
                             const TrialSimulator& simulator)
    : simulator_(simulator) {
  planned.truth_position_sd_m = planned.truth_heading_sd_rad = 0;
  drive_ = {platform.robot, std::move(planned), {}, 0, 0, 0, plan.seed};
  TrialDrive noisy = drive_;
  drive_.planned.robot.ticks_per_revolution *= kFiner;
  const Recording clean = simulator(drive_);
  for (const Signal signal : kSignals) nominal_[std::size_t(signal)] = signal_track(clean, signal);
  noisy.heading_walk_rad_per_sqrt_m = plan.noise.heading_walk_rad_per_sqrt_m;
  noisy.radius_scatter = plan.noise.radius_scatter;
  noisy.motor_scatter = plan.noise.motor_scatter;
  noisy.planned.truth_position_sd_m = plan.noise.position_sd_m;
  noisy.planned.truth_heading_sd_rad = plan.noise.heading_sd_rad;
  std::array<SignalTrack, 2> tracks, without;
  for (int i = 0; i < kNoiseDrives; ++i) {
    noisy.seed = RandomStream(plan.seed, "trial noise floor", std::uint64_t(i)).bits() >> 1;
    const Recording recording = simulator(noisy);
    for (const Signal signal : kSignals) {
      const std::size_t s = std::size_t(signal);
      const SignalTrack track = signal_track(recording, signal);
      tracks[s].insert(tracks[s].end(), track.begin(), track.end());
      without[s].insert(without[s].end(), nominal_[s].begin(), nominal_[s].end());
    }
  }
  noise_[std::size_t(Signal::odometry)] = signal_size(tracks[0], &without[0]);
  // Motors that follow exactly leave quantisation as the only noise of their signal.
  noise_[std::size_t(Signal::motors)] = signal_size(tracks[1], nullptr);
}

double SeverityScale::severity(const Effect& effect, Signal signal) const {
  TrialDrive drive = drive_;
  drive.effects = {effect};
  try {
    const SignalTrack track = signal_track(simulator_(drive), signal);
    const SignalSize change = signal_size(track, &nominal_[std::size_t(signal)]);
    return umbsim::severity(change, noise(signal));
  } catch (const std::runtime_error&) {  // RunError, or InputError: it tips over, or is driven out of all bounds
    return std::numeric_limits<double>::infinity();
  }
}

ScaledEffect scale_effect(const DrawnEffect& drawn, double severity, const Range& drawn_from, double noise_level,
                          const SeverityScale& scale, RandomStream& random) {
  // Drawn whether needed or not, so that what follows in the stream does not depend on it.
  const double plausible = drawn.plausible.min * std::pow(drawn.plausible.max / drawn.plausible.min, random.uniform());
  std::optional<AmplitudeSearch> best;
  for (const Signal signal : kSignals) {
    AmplitudeSearch search(drawn, signal, severity, noise_level, scale);
    if (!best || search.highest() > best->highest()) best.emplace(search);
    if (best->highest() >= drawn_from.max) break;
  }
  if (best->highest() >= kLeastSeverity) {
    if (best->highest() < drawn_from.max) best->want(same_place(severity, drawn_from, best->highest()));
    return best->solved(severity);
  }
  ScaledEffect scaled{drawn.at(plausible), severity, 0, Signal::odometry, true};
  scaled.severity = scale.severity(scaled.effect, Signal::odometry) / noise_level;
  return scaled;
}

}  // namespace umbsim
