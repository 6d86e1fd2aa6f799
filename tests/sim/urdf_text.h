#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

#include "core/error.h"
#include "sim/model/robot_model.h"

namespace umbsim::testing {

/// A small robot: wheels of radius 0.1 m at y = +-0.2 m, a ball 0.3 m ahead, root link on the axle.
inline const std::string kRobot = R"(<robot name="mini">
<link name="hull">
  <inertial><origin xyz="0.05 0.01 0.02"/><mass value="10"/>
    <inertia ixx="0.2" ixy="0.01" ixz="0" iyy="0.3" iyz="0" izz="0.4"/></inertial>
</link>
<link name="wheel_l">
  <inertial><mass value="1"/><inertia ixx="0.003" ixy="0" ixz="0" iyy="0.005" iyz="0" izz="0.003"/></inertial>
  <collision><origin rpy="1.5707963 0 0"/><geometry><cylinder radius="0.1" length="0.04"/></geometry></collision>
</link>
<joint name="jl" type="continuous"><parent link="hull"/><child link="wheel_l"/>
  <origin xyz="0 0.2 0"/><axis xyz="0 1 0"/></joint>
<link name="wheel_r">
  <inertial><mass value="1"/><inertia ixx="0.003" ixy="0" ixz="0" iyy="0.005" iyz="0" izz="0.003"/></inertial>
  <collision><origin rpy="1.5707963 0 0"/><geometry><cylinder radius="0.1" length="0.04"/></geometry></collision>
</link>
<joint name="jr" type="continuous"><parent link="hull"/><child link="wheel_r"/>
  <origin xyz="0 -0.2 0"/><axis xyz="0 1 0"/></joint>
<link name="ball"><collision><geometry><sphere radius="0.03"/></geometry></collision></link>
<joint name="jb" type="fixed"><parent link="hull"/><child link="ball"/><origin xyz="0.3 0 -0.07"/></joint>
</robot>
)";

/// `text` with its first `from` replaced. Throws if there is none: a test must not pass by changing nothing.
inline std::string with(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  if (at == text.npos) throw std::logic_error("no such text: " + from);
  return text.replace(at, from.size(), to);
}

/// `text` with `more` before the closing tag.
inline std::string plus(const std::string& text, const std::string& more) {
  return with(text, "</robot>", more + "</robot>");
}

/// A link with unit-like inertia and, behind a joint to `parent`, the given collision geometry.
inline std::string part(const std::string& name, const std::string& joint_type, const std::string& parent,
                        const std::string& xyz, const std::string& axis, const std::string& geometry,
                        const std::string& rpy = "0 0 0") {
  const std::string collision =
      geometry.empty() ? ""
                       : "<collision><origin rpy=\"" + rpy + "\"/><geometry>" + geometry + "</geometry></collision>";
  return "<link name=\"" + name +
         "\"><inertial><mass value=\"0.5\"/><inertia ixx=\"0.001\" ixy=\"0\" ixz=\"0\" "
         "iyy=\"0.001\" iyz=\"0\" izz=\"0.001\"/></inertial>" +
         collision + "</link>\n<joint name=\"" + name + "_joint\" type=\"" + joint_type + "\"><parent link=\"" +
         parent + "\"/><child link=\"" + name + "\"/><origin xyz=\"" + xyz + "\"/><axis xyz=\"" + axis + "\"/>" +
         (joint_type == "continuous" || joint_type == "fixed"
              ? ""
              : "<limit lower=\"-1\" upper=\"1\" effort=\"1\" velocity=\"1\"/>") +
         "</joint>\n";
}

/// Writes a file of the test's own and returns its path.
inline std::string written(const std::string& text, const std::string& file_name = "mini.urdf") {
  const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
  const auto folder = std::filesystem::path(::testing::TempDir()) /
                      (std::string("umbsim_") + info->test_suite_name() + "_" + info->name());
  std::filesystem::create_directories(folder);
  const auto file = (folder / file_name).string();
  std::ofstream(file) << text;
  return file;
}

inline RobotModel loaded(const std::string& text, const DriveJoints& joints = {}) {
  return load_robot(written(text), joints);
}

/// The message with which load_robot refuses a file; fails the test if it accepts it.
inline std::string refusal_of_file(const std::string& file, const DriveJoints& joints = {}) {
  try {
    load_robot(file, joints);
  } catch (const InputError& error) {
    return error.what();
  }
  ADD_FAILURE() << file << " was accepted";
  return {};
}

inline std::string refusal(const std::string& text, const DriveJoints& joints = {}) {
  return refusal_of_file(written(text), joints);
}

}  // namespace umbsim::testing
