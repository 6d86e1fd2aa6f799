#include "experiment/sweep/sweep.h"

#include <fmt/format.h>

#include <set>

#include "core/random.h"
#include "experiment/scenario/settings.h"

namespace umbsim {
namespace {

// `robot: labmate.urdf` stands for `robot.urdf`.
std::string scenario_key(const std::string& key, const AxisValue& value) {
  return key == "robot" && value.yaml.rfind('{', 0) != 0 ? "robot.urdf" : key;
}

// The values of a grid's axes at a place of the mixed-radix count, the last axis fastest.
void grid_values(const Sweep& sweep, std::int64_t place, bool only_listed, std::vector<AxisValue>& values) {
  for (std::size_t i = sweep.axes.size(); i-- > 0;) {
    const Axis& axis = sweep.axes[i];
    if (only_listed && axis.sampled()) continue;
    const auto count = std::int64_t(axis.values.size());
    values[i] = axis.values[std::size_t(place % count)];
    place /= count;
  }
}

std::int64_t crossed(const Sweep& sweep) {
  std::int64_t product = 1;
  for (const Axis& axis : sweep.axes) product *= axis.sampled() ? 1 : std::int64_t(axis.values.size());
  return product;
}

void sample_values(const Sweep& sweep, std::int64_t sample, std::vector<AxisValue>& values) {
  std::size_t dimensions = 0, dimension = 0;
  for (const Axis& axis : sweep.axes) dimensions += axis.sampled();
  for (std::size_t i = 0; i < sweep.axes.size(); ++i) {
    if (!sweep.axes[i].sampled()) continue;
    values[i] = sampled_value(sweep.axes[i], sweep.shares[std::size_t(sample) * dimensions + dimension++]);
  }
}

// The scenario with these values in place of its own.
Scenario with_values(const Sweep& sweep, const std::vector<Axis>& axes, const std::vector<AxisValue>& values) {
  const std::lock_guard lock(*sweep.mutex);
  const YamlValue document(YAML::Clone(sweep.scenario), sweep.scenario_file, "");
  for (std::size_t i = 0; i < values.size(); ++i) {
    apply_setting(document, scenario_key(axes[i].key, values[i]) + "=" + values[i].yaml);
  }
  return read_scenario(document);
}

// The axis whose value is refused on its own; if none is, the values do not fit together.
[[noreturn]] void blame(const Sweep& sweep, const SweepPoint& point, const InputError& reason) {
  for (std::size_t i = 0; i < sweep.axes.size(); ++i) {
    try {
      load_scenario_robot(with_values(sweep, {sweep.axes[i]}, {point.values[i]}));
    } catch (const InputError& e) {
      throw InputError(sweep.axes[i].mark,
                       fmt::format("{}: value {}: {}", sweep.axes[i].key, point.values[i].yaml, e.what()));
    }
  }
  throw InputError(sweep.axes.front().mark,
                   fmt::format("point {} ({}): {}", point.number, label(sweep, point), reason.what()));
}

}  // namespace

SweepPoint sweep_point(const Sweep& sweep, std::int64_t number) {
  SweepPoint point;
  point.number = number;
  point.replicate = number % sweep.replicates;
  point.values.resize(sweep.axes.size());
  const std::int64_t place = number / sweep.replicates;
  if (sweep.design == Design::list) {
    for (std::size_t i = 0; i < sweep.axes.size(); ++i) point.values[i] = sweep.axes[i].values[std::size_t(place)];
  } else if (sweep.design == Design::grid) {
    grid_values(sweep, place, false, point.values);
  } else {
    const std::int64_t inner = crossed(sweep);
    grid_values(sweep, place % inner, true, point.values);
    sample_values(sweep, place / inner, point.values);
  }
  return point;
}

std::string label(const Sweep& sweep, const SweepPoint& point) {
  std::string text;
  for (std::size_t i = 0; i < sweep.axes.size(); ++i) {
    text += fmt::format("{}{}={}", i == 0 ? "" : ", ", sweep.axes[i].key, text_of_cell(point.values[i].cell));
  }
  if (sweep.replicates > 1) text += fmt::format(", replicate {}", point.replicate);
  return text;
}

Scenario scenario_of(const Sweep& sweep, const SweepPoint& point) {
  Scenario s = with_values(sweep, sweep.axes, point.values);
  if (sweep.own_seeds) {
    s.seed = RandomStream(s.seed, "sweep point", std::uint64_t(point.number)).bits() >> 1;
  } else {
    s.seed += std::uint64_t(point.replicate);
  }
  return s;
}

void check_points(const Sweep& sweep, const std::vector<std::int64_t>& numbers, const std::function<void()>& checked) {
  std::set<std::string> robots;
  for (const std::int64_t number : numbers) {
    const SweepPoint point = sweep_point(sweep, number);
    try {
      const Scenario s = scenario_of(sweep, point);
      if (robots.insert(s.robot.urdf + '\n' + s.robot.joints.left + '\n' + s.robot.joints.right).second)
        load_scenario_robot(s);
    } catch (const InputError& e) {
      blame(sweep, point, e);
    }
    if (checked) checked();
  }
}

}  // namespace umbsim
