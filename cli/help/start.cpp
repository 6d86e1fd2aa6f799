#include "cli/help/help.h"

namespace umbsim {

std::string start_text() {
  return "umbsim: a physics testbed for honest odometry\n"
         "\n"
         "What most people want:\n"
         "  umbsim run umbmark\n"
         "      drive UMBmark's squares, calibrate, drive again, report\n"
         "  umbsim import drive.mcap --robot robot.urdf\n"
         "      make a recording of your robot's log\n"
         "  umbsim calibrate RECORDING\n"
         "      calibrate its odometry by all methods; which one to trust\n"
         "  umbsim gap diagnose RECORDING\n"
         "      how robot and simulator differ, which effect explains it\n"
         "  umbsim sweep friction\n"
         "      a scenario over axes of parameters, checked, as in CI\n"
         "\n"
         "`umbsim --help` lists all commands; `umbsim run --help` tells of one.\n"
         "`umbsim list` names the scenarios, sweeps, trials and robots that are shipped.\n";
}

}  // namespace umbsim
