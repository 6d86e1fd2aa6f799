// Another project, which knows nothing but what was installed: odometry of two counts, and a robot from its URDF.
#include <cmath>
#include <cstdio>

#include "odometry/dead_reckoning.h"
#include "recording/names.h"
#include "sim/model/robot_model.h"

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  const umbsim::RobotModel robot = umbsim::load_robot(argv[1]);
  const double radius_m = robot.wheels[0].radius_m;
  umbsim::DeadReckoning reckoning({radius_m, radius_m, robot.wheelbase_m(), 1000}, {}, 0, 0);
  reckoning.update(1000, 1000);  // a turn of both wheels
  const double off_m = std::abs(reckoning.pose().x_m - 2 * M_PI * radius_m);
  std::printf("%s %s %.3f %g\n", umbsim::kRecordingFormat, robot.name.c_str(), robot.wheelbase_m(), off_m);
  return off_m < 1e-12 ? 0 : 1;
}
