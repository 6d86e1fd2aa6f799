// What columns of other people's logs are called.
#include "exchange/text/column_meaning.h"

#include <gtest/gtest.h>

namespace umbsim::exchange {
namespace {

TEST(ColumnMeaning, WheelsTimesAndPoses) {
  struct Case {
    const char* column;
    Role role;
    const char* unit;
  };
  for (const Case& c : std::vector<Case>{{"left_ticks", Role::left, "ticks"},
                                         {"right wheel [rad]", Role::right, "rad"},
                                         {"wheelLeft (rad/s)", Role::left, "rad/s"},
                                         {"enc_l", Role::left, ""},
                                         {"v_right_mps", Role::right, "m/s"},
                                         {"right_vel_rad_s", Role::right, "rad/s"},
                                         {"/joint_states/wheel_left_joint/position", Role::left, "rad"},
                                         {"/joint_states/wheel_right_joint/velocity", Role::right, "rad/s"},
                                         {"left_effort", Role::other, ""},
                                         {"left_cmd_radps", Role::left_command, "rad/s"},
                                         {"target_right [rpm]", Role::right_command, "rpm"},
                                         {"time_s", Role::time, "s"},
                                         {"t_ms", Role::time, "ms"},
                                         {"timestamp [ns]", Role::time, "ns"},
                                         {"__time", Role::time, "s"},
                                         {"x_m", Role::x, "m"},
                                         {"truth.y [mm]", Role::y, "mm"},
                                         {"theta_rad", Role::heading, "rad"},
                                         {"/vicon/robot/pose/orientation/w", Role::qw, "m"},
                                         {"/odom/twist/twist/linear/x", Role::other, ""},
                                         {"yaw_deg", Role::heading, "deg"}}) {
    const ColumnMeaning m = meaning_of(c.column);
    EXPECT_EQ(int(m.role), int(c.role)) << c.column;
    if (m.role != Role::qw && m.role != Role::other) {
      EXPECT_EQ(m.unit, c.unit) << c.column;
    }
  }
}

TEST(ColumnMeaning, PosesOfOneTopicBelongTogether) {
  EXPECT_EQ(meaning_of("/mocap/pose/position/x").group, meaning_of("/mocap/pose/orientation/w").group);
  EXPECT_NE(meaning_of("/mocap/pose/position/x").group, meaning_of("/odom/pose/pose/position/x").group);
}

TEST(ColumnMeaning, SidesAreWholeWords) {
  EXPECT_EQ(side_of(words_in("wheel_left_joint")), 'l');
  EXPECT_EQ(side_of(words_in("rightWheelJoint")), 'r');
  EXPECT_EQ(side_of(words_in("bright_cleft")), 0);
  EXPECT_EQ(side_of(words_in("left_to_right")), 0);
}

}  // namespace
}  // namespace umbsim::exchange
