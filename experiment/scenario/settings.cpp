#include "experiment/scenario/settings.h"

#include <algorithm>

#include "experiment/scenario/scenario.h"

namespace umbsim {
namespace {

// The same value without its place in a text: errors about it then name the key, and no line of the scenario file.
YAML::Node without_marks(const YAML::Node& node) {
  YAML::Node copy(node.Type());
  if (node.IsScalar()) copy = node.Scalar();
  for (const auto& entry : node) {
    if (node.IsMap())
      copy[entry.first.Scalar()] = without_marks(entry.second);
    else
      copy.push_back(without_marks(entry));
  }
  copy.SetTag(node.Tag());
  return copy;
}

// What reading the document says, "" if nothing.
std::string refusal(const YamlValue& document) {
  try {
    read_scenario(document);
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

}  // namespace

void apply_setting(const YamlValue& document, const std::string& setting) {
  const std::size_t equals = setting.find('=');
  if (equals == std::string::npos || equals == 0) {
    throw InputError("--set " + setting + ": must have the form key.path=value, as in course.side_m=2");
  }
  YAML::Node node = document.node();
  const std::string path = setting.substr(0, equals);
  for (std::size_t begin = 0; begin <= path.size();) {
    const std::size_t dot = std::min(path.find('.', begin), path.size());
    if (dot == begin) throw InputError("--set " + setting + ": empty part in the key path");
    if (node.IsDefined() && !node.IsNull() && !node.IsMap()) {
      throw InputError("--set " + setting + ": '" + path.substr(0, begin - 1) + "' is not a map");
    }
    YAML::Node child = node[path.substr(begin, dot - begin)];
    node.reset(child);
    begin = dot + 1;
  }
  const std::string text = setting.substr(equals + 1);
  if (text.empty()) throw InputError("--set " + setting + ": a value is missing after the =");
  node = without_marks(YamlValue::parse(text, "--set " + setting).node());
}

void blame_setting(const InputError& error, const std::vector<std::string>& settings,
                   const std::function<YamlValue(std::size_t)>& document) {
  const std::string what = error.what();
  std::size_t n = 0;
  while (n <= settings.size() && refusal(document(n)) != what) ++n;
  if (n == 0 || n > settings.size()) throw error;
  // Of a value that was set the file is named, but no line of it.
  const std::string file = document(0).file() + ": ";
  const bool set = what.rfind(file, 0) == 0;
  throw InputError("--set " + settings[n - 1] + ": " + (set ? what.substr(file.size()) : what));
}

}  // namespace umbsim
