#include "experiment/sweep/axis.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "core/text/yaml_text.h"

namespace umbsim {
namespace {

constexpr std::int64_t kMaxCount = 1000000;
// A step that misses `to` by less than this share of itself has reached it.
constexpr double kStepSlack = 1e-9;

// Steps of 0.01 should read 0.03, not 0.030000000000000002.
double tidy(double value) {
  const std::string text = fmt::format("{:.12g}", value);
  double result = value;
  std::from_chars(text.data(), text.data() + text.size(), result);
  return result;
}

AxisValue number_value(const Axis& axis, double value) {
  if (axis.integer) return {std::int64_t(std::llround(value)), fmt::format("{}", std::llround(value))};
  const double number = tidy(value);
  const std::string text = fmt::format("{}", number);
  return {cell_of(text), text};
}

// From `from` to `to`, evenly on the scale of the axis.
double between(const Axis& axis, double share) {
  if (share == 0) return axis.from;
  if (share == 1) return axis.to;
  if (axis.logarithmic) return axis.from * std::pow(axis.to / axis.from, share);
  return axis.from + (axis.to - axis.from) * share;
}

void add_count(Axis& axis, const YamlValue& value) {
  const std::int64_t count = value.integer(1, kMaxCount);
  if (count == 1 && axis.from != axis.to) value.fail("1 is out of range (must be >= 2 where from and to differ)");
  for (std::int64_t i = 0; i < count; ++i) {
    axis.values.push_back(number_value(axis, between(axis, count == 1 ? 0 : double(i) / double(count - 1))));
  }
}

void add_steps(Axis& axis, const YamlValue& value) {
  const double step = value.number(Bounds::positive());
  const double steps = std::floor((axis.to - axis.from) / step + kStepSlack);
  if (steps >= double(kMaxCount))
    value.fail(fmt::format("{} is out of range (must give <= {} values)", step, kMaxCount));
  for (double i = 0; i <= steps; ++i) axis.values.push_back(number_value(axis, axis.from + i * step));
}

void read_range(Axis& axis, const YamlValue& value, bool may_sample) {
  YamlMap map(value);
  axis.from = map.number("from", Bounds{});
  axis.to = map.number("to", Bounds{});
  axis.logarithmic = map.choice("scale", "linear", {"linear", "log"}) == "log";
  axis.integer = map.boolean("integer", false);
  const auto count = map.find("count"), step = map.find("step");
  map.finish();
  if (axis.to < axis.from)
    map.at("to").fail(fmt::format("{} is out of range (must be >= from = {})", axis.to, axis.from));
  if (axis.logarithmic && axis.from <= 0)
    map.at("from").fail(fmt::format("{} is out of range (must be > 0 with scale: log)", axis.from));
  if (count && step) value.fail("has both count and step; one of them says how many values there are");
  if (step && axis.logarithmic) step->fail("has no meaning with scale: log; give a count");
  if (may_sample && count) count->fail("has no meaning here: this design samples a range as often as `samples` says");
  if (may_sample && step) step->fail("has no meaning here: this design samples a range as often as `samples` says");
  if (count)
    add_count(axis, *count);
  else if (step)
    add_steps(axis, *step);
  else if (!may_sample)
    value.fail("must have count or step; only latin_hypercube and sobol sample a range without them");
}

// Flow YAML of any value, on one line.
std::string flow_text(const YamlValue& value) {
  YAML::Emitter out;
  out.SetMapFormat(YAML::Flow);
  out.SetSeqFormat(YAML::Flow);
  out << value.node();
  std::string text = out.c_str();
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

void check_key(const std::string& key, const SourceMark& mark) {
  if (!key.empty() && key.front() != '.' && key.back() != '.' && key.find("..") == std::string::npos &&
      key.find('=') == std::string::npos) {
    return;
  }
  throw InputError(mark, fmt::format("'{}': must be a key path of the scenario, as in course.side_m", key));
}

}  // namespace

AxisValue read_axis_value(const YamlValue& value) {
  const YAML::Node& node = value.node();
  if (node.IsNull()) value.fail("a value is missing");
  if (!node.IsScalar()) {
    const std::string text = flow_text(value);
    return {text, text};
  }
  // yaml-cpp tags a plain scalar "?".
  if (node.Tag() == "?") return {cell_of(node.Scalar()), node.Scalar()};
  return {node.Scalar(), yaml_string(node.Scalar())};
}

Axis read_axis(const std::string& key, const YamlValue& value, bool may_sample) {
  Axis axis;
  axis.key = key;
  axis.mark = value.mark();
  check_key(key, axis.mark);
  if (value.is_map()) {
    read_range(axis, value, may_sample);
    return axis;
  }
  for (const YamlValue& item : value.list()) {
    const AxisValue v = read_axis_value(item);
    for (const AxisValue& seen : axis.values) {
      if (seen.cell == v.cell) item.fail(fmt::format("'{}' is given twice", v.yaml));
    }
    axis.values.push_back(v);
  }
  if (axis.values.empty()) value.fail("must name at least one value");
  return axis;
}

AxisValue sampled_value(const Axis& axis, double share) {
  // Every integer takes the same share.
  if (axis.integer)
    return number_value(axis, std::min(axis.to, std::floor(axis.from + share * (axis.to - axis.from + 1))));
  return number_value(axis, between(axis, share));
}

}  // namespace umbsim
