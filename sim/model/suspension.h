#pragma once

#include <optional>
#include <vector>

#include "sim/model/robot_model.h"

namespace umbsim {

/// How a scenario springs its robot. A travel goes from where the wheel hangs free to its upper stop; under its load at
/// rest the wheel stands in the middle. 0: rigid. Empty: the URDF's upright prismatic joint, else the default travel
/// where the robot stands on more than three supports, else rigid.
struct SuspensionChoice {
  std::optional<double> wheel_travel_m;
  std::optional<double> caster_travel_m;
  double damping_ratio = 0.7;  ///< of each support's load on its spring
};

/// Travel of supports of which nothing is known, where there are more than three of them: two centimetres, or eight
/// times the root mean square height of an uneven floor, so that half of it covers four standard deviations. At most
/// what leaves the robot four times the stiffness against leaning that it needs to stand at all, and one wheel radius.
double default_travel_m(const RobotModel& robot, double floor_rms_m);

/// Load of each support on a flat floor (left wheel, right wheel, casters), N: by balance on three supports, as on
/// equal springs on more, where those that would have to pull carry nothing. Empty if the robot does not stand.
std::vector<double> rest_loads(const RobotModel& robot, double gravity_mps2);

/// Fills in the suspension of wheels and casters. Says in `remarks` where it comes from.
void suspend(RobotModel& robot, const SuspensionChoice& choice, double gravity_mps2, double floor_rms_m,
             std::vector<Remark>* remarks = nullptr);

/// Mass and centre of mass of the whole robot, base frame.
Inertial whole_body(const RobotModel& robot);

}  // namespace umbsim
