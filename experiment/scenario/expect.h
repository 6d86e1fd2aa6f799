#pragma once

#include <optional>
#include <string>
#include <vector>

#include "batch/condition.h"
#include "core/text/yaml_reader.h"

namespace umbsim {

/// What a figure must be: of a run, of every point of a sweep, or of a quantile over points.
struct Expectation {
  std::string figure;  ///< a key of summary.json; of a sweep `failed_points`, too
  std::optional<double> min;
  std::optional<double> max;
  std::optional<double> abs_max;
  std::optional<double> quantile;  ///< 0 to 1: of all points together, not of each
  std::vector<Condition> where;    ///< only the points where all hold
};

/// Who may have an expectation: of a run there is one point, without axes.
enum class ExpectationsOf { run, sweep };

/// Reads the map `expect:`. Throws InputError.
std::vector<Expectation> read_expectations(const YamlValue& value, ExpectationsOf whose);

/// "abs_max 5e-05", with these texts between and after.
std::string bounds_text(const Expectation& e, const char* between = " ", const char* after = ", ");
/// "recovery.e_d_error: abs_max 5e-05, quantile 0.95, where calibration.method = heading".
std::string text_of_expectation(const Expectation& e);

/// The number of points that could not be driven.
inline const std::string kFailedPoints = "failed_points";

/// Points with the columns that the expectations ask for.
struct FigureTable {
  struct Row {
    std::int64_t number = 0;
    std::string label;
    std::string error;  ///< why it could not be driven
    std::vector<Cell> cells;
  };
  std::vector<std::string> columns;
  std::vector<Row> rows;
};

/// One expectation held against one point, or against all of them.
struct Outcome {
  std::int64_t point = -1;  ///< -1: all points of the expectation
  std::string label;
  Cell value;
  bool met = false;
};

struct Check {
  Expectation expectation;
  std::vector<Outcome> outcomes;
  std::int64_t unmet = 0;
};

/// Columns that `check` needs.
std::vector<std::string> columns_of(const std::vector<Expectation>& expectations);

/// A point that could not be driven, or has no such figure, does not meet an expectation of it.
std::vector<Check> check(const std::vector<Expectation>& expectations, const FigureTable& table);

/// One line for each expectation, and the points below it that do not meet it, at most `most` of them.
std::string checks_text(const std::vector<Check>& checks, std::size_t most = 20);

bool all_met(const std::vector<Check>& checks);

}  // namespace umbsim
