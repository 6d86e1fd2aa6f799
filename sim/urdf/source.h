#pragma once

#include <urdf_model/model.h>

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sim/model/robot_model.h"

namespace umbsim {

/// A joint's spring: of <dynamics spring_stiffness>, or of Gazebo's <springStiffness> for that joint.
struct JointSpring {
  double stiffness = 0;  ///< N/m of a prismatic joint
  double reference = 0;  ///< joint position at which it is free
};

/// A URDF file as read: urdfdom's model and the line of every link and joint, for messages.
class UrdfSource {
 public:
  /// Throws InputError: missing file, folder, empty, not XML, SDF, unexpanded xacro, or whatever urdfdom complains of.
  explicit UrdfSource(std::string file);

  const urdf::ModelInterface& model() const { return *model_; }
  /// Without folders.
  std::string file_name() const;
  const std::string& file() const { return file_; }
  /// Stiffness 0 where the file gives none.
  JointSpring spring(const std::string& joint) const;

  /// Of a link's surface in Gazebo's elements.
  std::optional<double> friction(const std::string& link) const;

  /// What was found and taken, for those who want to read it; the source only collects it.
  void remark(Remark::Kind kind, const std::string& text) const { remarks_.push_back({kind, text}); }
  const std::vector<Remark>& remarks() const { return remarks_; }

  /// "link 'caster' (joint 'caster_joint')"; without the bracket for the root.
  std::string link_text(const std::string& link) const;
  /// "joint 'left_wheel' (link 'left_wheel_link')".
  std::string joint_text(const std::string& joint) const;

  /// These throw InputError with file, line, the element's name and `what`.
  [[noreturn]] void fail(const std::string& what) const;
  [[noreturn]] void fail_at_link(const std::string& link, const std::string& what) const;
  [[noreturn]] void fail_at_joint(const std::string& joint, const std::string& what) const;

 private:
  /// Throws urdfdom's words with the line of the element they name.
  [[noreturn]] void fail_with(const std::string& complaint) const;

  std::string file_;
  std::shared_ptr<const urdf::ModelInterface> model_;
  std::map<std::string, int> link_lines_;
  std::map<std::string, int> joint_lines_;
  std::map<std::string, JointSpring> springs_;
  std::map<std::string, double> frictions_;
  mutable std::vector<Remark> remarks_;
};

}  // namespace umbsim
