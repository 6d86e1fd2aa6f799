#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "experiment/scenario/scenario.h"
#include "experiment/sweep/axis.h"
#include "experiment/sweep/design.h"

namespace umbsim {

/// What the report of a sweep shows first; empty: what suits.
struct SweepView {
  std::string x;
  std::string y;
  std::string figure;
  bool logarithmic = false;  ///< colours and curves by the size of the figure, on a logarithmic scale
};

/// A sweep as a file describes it: one scenario over axes. Points are numbered from 0: the first axis changes slowest,
/// replicates fastest; a sampled design takes one sample after the other.
struct Sweep {
  std::string file;
  std::string name;
  std::string description;
  std::string scenario_file;
  std::vector<Axis> axes;
  Design design = Design::grid;
  std::int64_t samples = 0;         ///< of a sampled design
  std::vector<double> shares;       ///< of a sampled design: sample s, axis a at [s * axes + a]
  std::uint64_t sample_seed = 1;
  std::int64_t replicates = 1;
  bool own_seeds = false;           ///< every point has noise of its own; else the same noise at every point
  std::vector<Expectation> expect;
  SweepView view;
  std::string definition;           ///< all that the results depend on, as text
  std::int64_t points = 0;

  YAML::Node scenario;              ///< the scenario with `set`, before the axes
  std::shared_ptr<std::mutex> mutex =
      std::make_shared<std::mutex>();  ///< of `scenario`: yaml-cpp's nodes are not thread-safe
};

/// Reads a sweep file. `settings` (`course.side_m=2`) change its scenario, `axes` (`course.side_m=[2, 4]`) replace or
/// add axes. Throws InputError with file, line, key, value and bound. Whether the scenario takes the values is for
/// check_points.
Sweep read_sweep(const std::string& file, const std::vector<std::string>& settings = {},
                 const std::vector<std::string>& axes = {});

/// One point: its replicate, counted from 0, and its value on each axis.
struct SweepPoint {
  std::int64_t number = 0;
  std::int64_t replicate = 0;
  std::vector<AxisValue> values;
};
SweepPoint sweep_point(const Sweep& sweep, std::int64_t number);

/// "effects.wheelbase.relative=0.01, calibration.method=heading, replicate 2".
std::string label(const Sweep& sweep, const SweepPoint& point);

/// The scenario of a point. Thread-safe. Throws InputError.
Scenario scenario_of(const Sweep& sweep, const SweepPoint& point);

/// Throws InputError that names file, line, key, value and bound if the scenario does not take one of these points.
/// `checked` is called after each.
void check_points(const Sweep& sweep, const std::vector<std::int64_t>& numbers,
                  const std::function<void()>& checked = {});

}  // namespace umbsim
