#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "bench/worlds/engines/mujoco/model_xml.h"
#include "bench/worlds/engines/set_point.h"
#include "sim/model/push.h"

typedef struct mjModel_ mjModel;
typedef struct mjData_ mjData;

namespace umbsim::worlds::mujoco {

/// A rig in MuJoCo, at rest and settled at X_WB.
class MujocoRobot {
 public:
  /// Throws RunError if MuJoCo refuses the model or the robot does not stand.
  MujocoRobot(const Rig& rig, const MujocoOptions& options, const Pose2& X_WB);
  MujocoRobot(const MujocoRobot&) = delete;
  MujocoRobot& operator=(const MujocoRobot&) = delete;

  void advance(const std::array<double, 2>& command_radps, double duration_s);

  Pose2 pose() const;
  double wheel_angle(int wheel) const;
  double encoder_angle(int wheel) const;
  double tilt_rad() const;
  std::int64_t steps() const { return steps_; }

  void set_pull(const Pull& pull) { pull_ = pull; }
  void set_rolling_factor(int wheel, double factor) { wheels_[std::size_t(wheel)].rolling_factor = factor; }
  void set_carpet_drift(double x, double y) { drift_ = {x, y}; }

 private:
  struct WheelPart {
    int geom = 0;
    int motor = 0;  // index in qpos
    int play = -1;  // index in qpos, -1: none
    double radius_m = 0;
    double last_rad = 0;
    double zero_wheel_rad = 0, zero_shaft_rad = 0;
    double rolling_factor = 1;
    SetPoint set_point{Motor{}};
  };

  void find_parts();
  void settle(const Pose2& X_WB);
  double load_n(int wheel) const;
  void press_tyre(int wheel);
  void step();
  void lay_floor();
  void grip();
  void pull();
  void carry();
  void turn(double angle_rad);
  void note_heading();
  double turned(int wheel) const;

  Rig rig_;
  MujocoOptions options_;
  int base_ = 0;
  std::array<WheelPart, 2> wheels_;
  std::vector<std::array<int, 2>> supports_;  // geom and mocap body, on uneven floors
  Pull pull_;
  std::array<double, 2> drift_{};
  double heading_rad_ = 0;
  std::int64_t steps_ = 0;
  std::unique_ptr<mjModel, void (*)(mjModel*)> owned_model_;
  std::unique_ptr<mjData, void (*)(mjData*)> owned_data_;
  mjModel* model_;
  mjData* data_;
};

}  // namespace umbsim::worlds::mujoco
