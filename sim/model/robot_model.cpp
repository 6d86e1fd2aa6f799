#include "sim/model/robot_model.h"

namespace umbsim {

double RobotModel::total_mass_kg() const {
  double sum = base.mass_kg;
  for (const Wheel& wheel : wheels) sum += wheel.mass_kg;
  for (const Caster& caster : casters) sum += caster.fork.mass_kg + caster.wheel_mass_kg;
  return sum;
}

}  // namespace umbsim
