#pragma once

#include <array>
#include <memory>
#include <vector>

#include "experiment/replay/recorded_shafts.h"
#include "experiment/replay/traced_run.h"
#include "experiment/scenario/scenario.h"
#include "recording/command_features.h"
#include "recording/recording.h"
#include "recording/stretches.h"

namespace umbsim {

/// Drives a recorded robot's runs again in the simulator, under any effects: from the recorded ticks (each wheel's
/// shaft turns as the encoder says, seen through the encoder's faults backwards) or from the recorded commands.
class Replay {
 public:
  /// `scenario` describes the robot and floor as the experimenter believes them: its effects act in every replay, below
  /// those asked for; its course and runs are not used. The wheel radius and wheelbase that the recording states go
  /// before the URDF's. `by_tracker`: the robot meets a cable or a patch where the recording's tracker saw it then
  /// (seen_track.h), else where the replay has come to: a prediction knows nothing of the way but the ticks. Throws
  /// InputError.
  /// `first_run`: number of the first run among all that the robot has driven, for what wears from run to run.
  Replay(const Scenario& scenario, const Recording& recording, bool by_tracker = true, int first_run = 0);

  const Recording& recording() const { return recording_; }
  const RobotModel& nominal() const { return nominal_; }
  int first_run() const { return first_run_; }
  /// Of the drive wheels, the narrower one; 0 where the recording names no URDF, or that gives none.
  double wheel_width_m() const;
  const Scenario& scenario() const { return scenario_; }
  const std::vector<Stretch>& stretches(std::size_t run) const { return stretches_[run]; }

  /// Absolute poses at the times of the run's truth. The start is where odometry lies best on the first part of the
  /// track. `roughness_m_per_sqrt_m`: of what the wheels roll on, as noise.wheel_noise_m_per_sqrt_m of a scenario.
  /// Wheels that scrub hold or give way with every grain of it, so that its mean effect is part of the robot's path:
  /// the run is driven over some grains and over their mirror image, whose random errors cancel, and the mean of both
  /// is returned. Throws RunError, InputError.
  std::vector<Pose2> poses(std::size_t run, const std::vector<Effect>& effects,
                           double roughness_m_per_sqrt_m = 0) const;

  /// Whether wheels scrub on rigid tyres under effects, those of the scenario included.
  bool scrubs(const std::vector<Effect>& effects) const;

  /// What the encoders would count, as angles in radians (left, right), at the times of the encoder samples when the
  /// recorded commands are driven open loop. Lost counts are lost in the mean; rounded only to steps that are coarser
  /// than the recording's counts.
  std::vector<std::array<double, 2>> counts(std::size_t run, const std::vector<Effect>& effects) const;

  /// How the robot is driven and read under effects, as it would show in the recording.
  CommandFeatures command_features(const std::vector<Effect>& effects) const;

 private:
  Rig rig(std::size_t run, const std::vector<Effect>& effects) const;
  Rig shafts_as_counted(Rig rig) const;
  /// Speeds (left, right) at the encoders' samples, rad/s.
  std::array<std::vector<double>, 2> shafts(std::size_t run, const Rig& supposed) const;
  /// Of a run with such shafts.
  std::shared_ptr<const EvenStretches> even(std::size_t run, const std::array<std::vector<double>, 2>& shafts) const;
  ShaftDrive drive_of(std::size_t run, const Rig& supposed, double roughness_m_per_sqrt_m) const;
  std::vector<Pose2> driven(std::size_t run, const std::vector<Effect>& effects, double roughness_m_per_sqrt_m) const;
  double coarse_step(const Rig& rig) const;
  CommandFeatures asked(const CommandedMotion& motion) const;

  Scenario scenario_;
  const Recording& recording_;
  bool by_tracker_;
  int first_run_;
  RobotModel nominal_;
  std::vector<std::vector<Stretch>> stretches_;
  std::vector<Pose2> start_;                                // of each run
  CommandFeatures as_declared_{};                           // what shows where the course is driven as it was declared
  int steps_ = 1;                                           // of the simulator in one period of the encoders
  double count_step_ = 1;                                   // width of the encoders' steps, in counts of the recording
  std::vector<CommandLag> lag_;                             // of the counts behind the commands, per run
  std::vector<EncoderSpec> believed_;                       // of each run, as the scenario has them
  std::vector<std::array<std::vector<double>, 2>> shafts_;  // of each run, if they are so
  std::vector<std::shared_ptr<const EvenStretches>> even_;  // of each run, if its shafts are so
  std::shared_ptr<Traces> traces_ = std::make_shared<Traces>(kTracesKept);
};

/// The scenario that a recording alone suggests: its robot, course, speeds and encoder rate.
Scenario scenario_of(const Recording& recording, const std::string& directory);

}  // namespace umbsim
