#pragma once

#include <urdf_model/model.h>

#include <map>
#include <memory>
#include <string>

namespace umbsim {

/// A URDF file as read: urdfdom's model and the line of every link and joint, for messages.
class UrdfSource {
 public:
  /// Throws InputError: missing file, folder, empty, not XML, SDF, unexpanded xacro, or whatever urdfdom complains of.
  explicit UrdfSource(std::string file);

  const urdf::ModelInterface& model() const { return *model_; }
  /// Without folders.
  std::string file_name() const;

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
};

}  // namespace umbsim
