#include "sim/urdf/source.h"

#include <console_bridge/console.h>
#include <fmt/format.h>
#include <tinyxml2.h>
#include <urdf_parser/urdf_parser.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <mutex>
#include <string_view>
#include <utility>

#include "core/error.h"
#include "sim/urdf/simplified.h"

namespace umbsim {
namespace {

// Takes urdfdom's messages off the terminal and keeps the errors: urdfdom drops an element that it cannot read, says so
// and goes on. A <visual> is no matter. The handler is global to the process: use under lock.
class ComplaintCollector : public console_bridge::OutputHandler {
 public:
  ComplaintCollector() { console_bridge::useOutputHandler(this); }
  ~ComplaintCollector() override { console_bridge::restorePreviousOutputHandler(); }

  void log(const std::string& text, console_bridge::LogLevel level, const char*, int) override {
    if (level < console_bridge::CONSOLE_BRIDGE_LOG_ERROR) return;
    if (text.starts_with("Could not parse visual")) {
      cause_.clear();
      return;
    }
    cause_ += (cause_.empty() ? "" : "; ") + text;
    if (text.starts_with("Could not parse")) settle();
  }

  const std::string& text() {
    settle();
    return text_;
  }

 private:
  void settle() {
    if (!cause_.empty()) text_ += (text_.empty() ? "" : "; ") + cause_;
    cause_.clear();
  }

  std::string cause_;  // not yet known of which element
  std::string text_;
};

std::string read_text(const std::string& file) {
  std::error_code ignored;
  if (std::filesystem::is_directory(file, ignored)) throw InputError({file}, "is a folder, not a URDF file");
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw InputError({file}, "cannot be read: no such URDF file, or no permission");
  constexpr std::size_t kMost = 16u << 20;  // far more than any; a device may never end
  std::string text;
  std::array<char, 1 << 14> block;
  while (text.size() <= kMost && (stream.read(block.data(), block.size()), stream.gcount() > 0)) {
    text.append(block.data(), std::size_t(stream.gcount()));
  }
  if (text.size() > kMost) throw InputError({file}, fmt::format("is longer than the {} bytes allowed", kMost));
  const bool blank = std::all_of(text.begin(), text.end(), [](unsigned char c) { return std::isspace(c); });
  if (blank) throw InputError({file}, "is empty, not a URDF file");
  if (text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff")) {
    throw InputError({file}, "is written in UTF-16: convert it with `iconv -f utf-16 -t utf-8`");
  }
  return text;
}

// XML_ERROR_MISMATCHED_ELEMENT -> "mismatched element".
std::string plain_words(std::string_view error_name) {
  constexpr std::string_view kPrefix = "XML_ERROR_";
  if (error_name.starts_with(kPrefix)) error_name.remove_prefix(kPrefix.size());
  std::string words(error_name);
  for (char& c : words) c = c == '_' ? ' ' : char(std::tolower(static_cast<unsigned char>(c)));
  return words;
}

const tinyxml2::XMLElement* robot_element(const tinyxml2::XMLDocument& document, const std::string& file) {
  if (document.Error()) {
    throw InputError({file, document.ErrorLineNum()},
                     fmt::format("not a URDF: not well-formed XML ({})", plain_words(document.ErrorName())));
  }
  const tinyxml2::XMLElement* root = document.RootElement();
  if (!root) throw InputError({file}, "not a URDF: no XML element in it");
  const std::string name = root->Name();
  if (name == "sdf") throw InputError({file, root->GetLineNum()}, "an SDF file, not a URDF: convert it to URDF first");
  if (name != "robot") {
    throw InputError({file, root->GetLineNum()},
                     fmt::format("not a URDF: the outermost element is <{}>, not <robot>", name));
  }
  return root;
}

// A bare xmlns:xacro is harmless (published URDFs have it). Text inside <gazebo> is for Gazebo's plugins.
void refuse_xacro(const tinyxml2::XMLElement& element, const std::string& file) {
  const auto refuse = [&](const tinyxml2::XMLElement& at, const std::string& what) {
    throw InputError({file, at.GetLineNum()},
                     fmt::format("{} is xacro, not URDF: run `xacro {} > robot.urdf` and use the result", what,
                                 std::filesystem::path(file).filename().string()));
  };
  const std::string_view name = element.Name();
  if (name == "gazebo") return;
  // What is left of an expansion matters only where it is used, and that is seen there.
  if (name == "xacro:property" || name == "xacro:arg") return;
  if (name.starts_with("xacro:")) refuse(element, fmt::format("<{}>", name));
  for (const auto* attribute = element.FirstAttribute(); attribute; attribute = attribute->Next()) {
    const std::string_view value = attribute->Value();
    if (name == "mesh" && attribute->Name() == std::string_view("filename")) continue;  // is not found, and said so
    if (value.find("${") == value.npos && value.find("$(") == value.npos) continue;
    refuse(element, fmt::format("<{}> {}=\"{}\"", name, attribute->Name(), value));
  }
  for (const auto* child = element.FirstChildElement(); child; child = child->NextSiblingElement()) {
    refuse_xacro(*child, file);
  }
}

std::map<std::string, int> lines_of(const tinyxml2::XMLElement& robot, const char* tag) {
  std::map<std::string, int> lines;
  for (const auto* e = robot.FirstChildElement(tag); e; e = e->NextSiblingElement(tag)) {
    if (const char* name = e->Attribute("name")) lines.emplace(name, e->GetLineNum());
  }
  return lines;
}

int line_in(const std::map<std::string, int>& lines, const std::string& name) {
  const auto found = lines.find(name);
  return found == lines.end() ? 0 : found->second;
}

// The name in "... for Link [caster]", or empty.
std::string named_after(const std::string& complaint, std::string_view tag) {
  const auto at = complaint.find(tag);
  if (at == complaint.npos) return {};
  const auto from = at + tag.size();
  return complaint.substr(from, complaint.find(']', from) - from);
}

struct Parsed {
  std::shared_ptr<const urdf::ModelInterface> model;
  std::string complaint;
};

Parsed parse(const std::string& text) {
  static std::mutex mutex;
  const std::lock_guard lock(mutex);
  ComplaintCollector complaints;
  try {
    auto model = urdf::parseURDF(text);
    return {model, complaints.text()};
  } catch (const std::exception& error) {
    return {nullptr, error.what()};
  }
}

}  // namespace

UrdfSource::UrdfSource(std::string file) : file_(std::move(file)) {
  const std::string text = read_text(file_);
  tinyxml2::XMLDocument document;
  document.Parse(text.data(), text.size());
  robot_element(document, file_);
  tinyxml2::XMLElement& robot = *document.RootElement();
  refuse_xacro(robot, file_);
  link_lines_ = lines_of(robot, "link");
  joint_lines_ = lines_of(robot, "joint");
  springs_ = springs_of(robot);
  frictions_ = frictions_of(robot);
  for (const auto& [link, shape] : drop_odd_collisions(robot)) {
    remark(Remark::Kind::ignored,
           fmt::format("link '{}': a collision {}, which is no shape of URDF (sphere, cylinder, box or mesh)", link,
                       shape.empty() ? "without a shape" : "<" + shape + ">"));
  }
  for (const std::string& joint : simplify(robot)) {
    remark(Remark::Kind::assumed,
           fmt::format("joint '{}': its <limit> is missing or incomplete, taken as none", joint));
  }
  tinyxml2::XMLPrinter printer;
  document.Print(&printer);
  const Parsed parsed = parse(printer.CStr());
  model_ = parsed.model;
  if (!model_ || !parsed.complaint.empty()) fail_with(parsed.complaint);
}

void UrdfSource::fail_with(const std::string& complaint) const {
  const std::string what = "not a valid URDF: " + complaint;
  const std::string link = named_after(complaint, "Link [");
  if (model_ && model_->getLink(link)) fail_at_link(link, what);
  const int line =
      line_in(link.empty() ? joint_lines_ : link_lines_, link.empty() ? named_after(complaint, "oint [") : link);
  throw InputError({file_, line}, what);
}

std::string UrdfSource::file_name() const { return std::filesystem::path(file_).filename().string(); }

JointSpring UrdfSource::spring(const std::string& joint) const {
  const auto found = springs_.find(joint);
  return found == springs_.end() ? JointSpring{} : found->second;
}

std::optional<double> UrdfSource::friction(const std::string& link) const {
  const auto found = frictions_.find(link);
  return found == frictions_.end() ? std::nullopt : std::optional<double>(found->second);
}

std::string UrdfSource::link_text(const std::string& link) const {
  const auto found = model_->getLink(link);
  if (!found || !found->parent_joint) return fmt::format("link '{}'", link);
  return fmt::format("link '{}' (joint '{}')", link, found->parent_joint->name);
}

std::string UrdfSource::joint_text(const std::string& joint) const {
  const auto found = model_->getJoint(joint);
  if (!found) return fmt::format("joint '{}'", joint);
  return fmt::format("joint '{}' (link '{}')", joint, found->child_link_name);
}

void UrdfSource::fail(const std::string& what) const { throw InputError({file_}, what); }

void UrdfSource::fail_at_link(const std::string& link, const std::string& what) const {
  throw InputError({file_, line_in(link_lines_, link)}, link_text(link) + ": " + what);
}

void UrdfSource::fail_at_joint(const std::string& joint, const std::string& what) const {
  throw InputError({file_, line_in(joint_lines_, joint)}, joint_text(joint) + ": " + what);
}

}  // namespace umbsim
