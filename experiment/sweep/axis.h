#pragma once

#include <string>
#include <vector>

#include "batch/condition.h"
#include "core/text/yaml_reader.h"

namespace umbsim {

/// One value of an axis: as it is shown and stored, and as the scenario reads it.
struct AxisValue {
  Cell cell;
  std::string yaml;
};

/// A key of the scenario that a sweep varies.
struct Axis {
  std::string key;                ///< effects.wheelbase.relative, course.side_m, seed, robot, ...
  SourceMark mark;                ///< where its values stand in the sweep file
  std::vector<AxisValue> values;  ///< listed, or a range with its steps; empty: sampled between from and to
  double from = 0;
  double to = 0;
  bool logarithmic = false;
  bool integer = false;
  bool sampled() const { return values.empty(); }
};

/// Reads the values of an axis: a list, {from, to, count} or {from, to, step}, or with `may_sample` {from, to}. Throws
/// InputError.
Axis read_axis(const std::string& key, const YamlValue& value, bool may_sample);

/// The value at `share` (0 to 1) of a sampled axis.
AxisValue sampled_value(const Axis& axis, double share);

AxisValue read_axis_value(const YamlValue& value);

}  // namespace umbsim
