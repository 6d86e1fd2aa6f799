#include "experiment/scenario/expect.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "core/text/wrapped_text.h"
#include "experiment/scenario/figure_names.h"

namespace umbsim {
namespace {

std::optional<double> optional_number(YamlMap& map, const char* key, Bounds bounds = {}) {
  const auto value = map.find(key);
  return value ? std::optional(value->number(bounds)) : std::nullopt;
}

std::vector<Condition> read_where(const YamlValue& value) {
  std::vector<Condition> conditions;
  const auto read = [&](const YamlValue& item) {
    try {
      conditions.push_back(parse_condition(item.string(), "the condition"));
    } catch (const InputError& e) {
      // Once with the place, whichever of both found the fault.
      if (std::string(e.what()).rfind("the condition", 0) == 0) item.fail(e.what());
      throw;
    }
  };
  if (!value.is_list())
    read(value);
  else
    for (const YamlValue& item : value.list()) read(item);
  return conditions;
}

Expectation read_one(const std::string& figure, const YamlValue& value, ExpectationsOf whose) {
  YamlMap map(value);
  Expectation e;
  e.figure = figure;
  e.min = optional_number(map, "min");
  e.max = optional_number(map, "max");
  e.abs_max = optional_number(map, "abs_max", Bounds::at_least(0));
  if (whose == ExpectationsOf::sweep && figure != kFailedPoints) {
    e.quantile = optional_number(map, "quantile", Bounds::between(0, 1));
    if (const auto where = map.find("where")) e.where = read_where(*where);
  }
  map.finish();
  if (!e.min && !e.max && !e.abs_max) value.fail("must have a bound: min, max or abs_max");
  if (e.min && e.max && *e.min > *e.max) value.fail(fmt::format("min = {} is above max = {}", *e.min, *e.max));
  return e;
}

std::size_t column(const FigureTable& table, const std::string& name) {
  const auto found = std::find(table.columns.begin(), table.columns.end(), name);
  return std::size_t(found - table.columns.begin());
}

bool in_scope(const FigureTable& table, const FigureTable::Row& row, const Expectation& e) {
  return std::all_of(e.where.begin(), e.where.end(),
                     [&](const Condition& c) { return fulfils(row.cells[column(table, c.key)], c); });
}

bool within(const Expectation& e, const Cell& cell) {
  const double value = number_of(cell);
  if (std::isnan(value)) return false;
  return (!e.min || value >= *e.min) && (!e.max || value <= *e.max) && (!e.abs_max || std::abs(value) <= *e.abs_max);
}

// The q-quantile by linear interpolation between order statistics (type 7 of Hyndman & Fan 1996, as R and NumPy do).
double quantile(std::vector<double> values, double q) {
  std::sort(values.begin(), values.end());
  const double place = q * double(values.size() - 1);
  const auto below = std::size_t(place);
  if (below + 1 >= values.size()) return values.back();
  return values[below] + (place - double(below)) * (values[below + 1] - values[below]);
}

Outcome over_all_points(const Expectation& e, const std::vector<Outcome>& points) {
  std::vector<double> values;
  for (const Outcome& o : points) {
    // abs_max bounds sizes, so the quantile is one of sizes.
    if (is_number(o.value)) values.push_back(e.abs_max ? std::abs(number_of(o.value)) : number_of(o.value));
  }
  Outcome all;
  all.label = fmt::format("{} quantile of {} points", *e.quantile, values.size());
  if (values.empty()) return all;
  all.value = quantile(values, *e.quantile);
  // A point without a value could be anything.
  all.met = values.size() == points.size() && within(e, all.value);
  return all;
}

Check check_one(const Expectation& e, const FigureTable& table) {
  Check c{e, {}, 0};
  if (e.figure == kFailedPoints) {
    const auto failed =
        std::count_if(table.rows.begin(), table.rows.end(), [](const auto& r) { return !r.error.empty(); });
    c.outcomes.push_back({-1, "all points", std::int64_t(failed), within(e, std::int64_t(failed))});
  } else {
    const std::size_t figure = column(table, e.figure);
    for (const FigureTable::Row& row : table.rows) {
      if (!in_scope(table, row, e)) continue;
      const Cell& value = row.cells[figure];
      c.outcomes.push_back({row.number, row.label, value, row.error.empty() && within(e, value)});
    }
    if (c.outcomes.empty())
      c.outcomes.push_back({-1, "no point fulfils the condition", {}, false});
    else if (e.quantile)
      c.outcomes = {over_all_points(e, c.outcomes)};
  }
  c.unmet = std::count_if(c.outcomes.begin(), c.outcomes.end(), [](const Outcome& o) { return !o.met; });
  return c;
}

// Furthest out, as the bounds see it.
const Outcome& worst(const Check& c) {
  const Expectation& e = c.expectation;
  const auto size = [&](const Outcome& o) {
    const double value = number_of(o.value);
    if (std::isnan(value)) return -std::numeric_limits<double>::infinity();
    return e.abs_max ? std::abs(value) : e.max ? value : -value;
  };
  return *std::max_element(c.outcomes.begin(), c.outcomes.end(),
                           [&](const Outcome& a, const Outcome& b) { return size(a) < size(b); });
}

std::string value_text(const Cell& value) {
  return is_number(value) ? fmt::format("{:.6g}", number_of(value)) : "no value";
}

std::string check_text(const Check& c, std::size_t most) {
  const bool alone = c.outcomes.size() == 1;
  std::string text = fmt::format("  {:<8} {}", c.unmet == 0 ? "met" : "NOT MET", text_of_expectation(c.expectation));
  constexpr std::size_t kIndent = 11;
  if (alone) {
    return wrapped(text + fmt::format("  ({}: {})", c.outcomes[0].label, value_text(c.outcomes[0].value)), kIndent);
  }
  if (c.unmet == 0) {
    return wrapped(text + fmt::format("  ({} points, worst {})", c.outcomes.size(), value_text(worst(c).value)),
                   kIndent);
  }
  text = wrapped(text + fmt::format("  ({} of {} points)", c.unmet, c.outcomes.size()), kIndent);
  std::size_t listed = 0;
  for (const Outcome& o : c.outcomes) {
    if (o.met || listed++ >= most) continue;
    text += wrapped(fmt::format("{:11}point {}, {}: {}", "", o.point, o.label, value_text(o.value)), kIndent + 2);
  }
  if (listed > most) text += fmt::format("           and {} more\n", listed - most);
  return text;
}

}  // namespace

std::vector<Expectation> read_expectations(const YamlValue& value, ExpectationsOf whose) {
  std::vector<Expectation> expectations;
  YamlMap map(value);
  std::vector<std::string> known = figure_names();
  if (whose == ExpectationsOf::sweep) known.push_back(kFailedPoints);
  for (const auto& [figure, bounds] : map.entries()) {
    if (std::find(known.begin(), known.end(), figure) == known.end()) {
      bounds.fail("there is no such figure; " + list_choices(figure, known));
    }
    if (!bounds.is_list())
      expectations.push_back(read_one(figure, bounds, whose));
    else
      for (const YamlValue& item : bounds.list()) expectations.push_back(read_one(figure, item, whose));
  }
  return expectations;
}

std::string bounds_text(const Expectation& e, const char* between, const char* after) {
  std::string text;
  const auto add = [&](const char* name, const std::optional<double>& bound) {
    if (bound) text += fmt::format("{}{}{}{}", text.empty() ? "" : after, name, between, *bound);
  };
  add("min", e.min), add("max", e.max), add("abs_max", e.abs_max), add("quantile", e.quantile);
  return text;
}

std::string text_of_expectation(const Expectation& e) {
  std::string text = e.figure + ": " + bounds_text(e);
  for (std::size_t i = 0; i < e.where.size(); ++i) {
    text += fmt::format("{}{} {} {}", i == 0 ? ", where " : " and ", e.where[i].key, e.where[i].op,
                        text_of_cell(e.where[i].value));
  }
  return text;
}

std::vector<std::string> columns_of(const std::vector<Expectation>& expectations) {
  std::set<std::string> names;
  for (const Expectation& e : expectations) {
    if (e.figure != kFailedPoints) names.insert(e.figure);
    for (const Condition& c : e.where) names.insert(c.key);
  }
  return {names.begin(), names.end()};
}

std::vector<Check> check(const std::vector<Expectation>& expectations, const FigureTable& table) {
  std::vector<Check> checks;
  for (const Expectation& e : expectations) checks.push_back(check_one(e, table));
  return checks;
}

std::string checks_text(const std::vector<Check>& checks, std::size_t most) {
  std::string text = checks.empty() ? "" : "Expectations\n";
  for (const Check& c : checks) text += check_text(c, most);
  return text;
}

bool all_met(const std::vector<Check>& checks) {
  return std::all_of(checks.begin(), checks.end(), [](const Check& c) { return c.unmet == 0; });
}

}  // namespace umbsim
