#include "experiment/sweep/sweep_result.h"

#include <algorithm>

namespace umbsim {
namespace {

// Of all points: the columns that the expectations ask for.
FigureTable table_of(const Sweep& sweep, Store& store) {
  FigureTable table;
  table.columns = columns_of(sweep.expect);
  std::vector<std::string> columns{"point", "error"};
  columns.insert(columns.end(), table.columns.begin(), table.columns.end());
  Statement rows = store.select(columns, {}, "expect");
  while (rows.step()) {
    FigureTable::Row row;
    row.number = rows.integer(0);
    row.error = rows.text(1);
    row.label = label(sweep, sweep_point(sweep, row.number));
    for (int i = 2; i < rows.columns(); ++i) row.cells.push_back(rows.cell(i));
    table.rows.push_back(std::move(row));
  }
  return table;
}

Json check_json(const Check& c) {
  Json unmet = Json::array();
  for (const Outcome& o : c.outcomes) {
    if (o.met) continue;
    Json item;
    if (o.point >= 0) item["point"] = o.point;
    item["where"] = o.label;
    item["value"] = is_number(o.value) ? Json(number_of(o.value)) : Json();
    unmet.push_back(std::move(item));
  }
  return {{"expectation", text_of_expectation(c.expectation)},
          {"figure", c.expectation.figure},
          {"met", c.unmet == 0},
          {"checked", c.outcomes.size()},
          {"unmet", std::move(unmet)}};
}

}  // namespace

SweepResult measure_sweep(const Sweep& sweep, Store& store) {
  SweepResult result;
  const FigureTable table = table_of(sweep, store);
  for (const FigureTable::Row& row : table.rows) {
    if (!row.error.empty()) result.failed.push_back({row.number, row.label, row.error});
  }
  for (const auto& [number, warning] : store.warnings()) {
    result.warned.push_back({number, label(sweep, sweep_point(sweep, number)), warning});
  }
  result.done = std::int64_t(table.rows.size() - result.failed.size());
  result.missing = sweep.points - std::int64_t(table.rows.size());
  result.checks = check(sweep.expect, table);
  result.failures_are_expected = std::any_of(sweep.expect.begin(), sweep.expect.end(),
                                             [](const Expectation& e) { return e.figure == kFailedPoints; });
  return result;
}

Json sweep_json(const Sweep& sweep, const SweepResult& result) {
  Json failed = Json::array(), warned = Json::array(), checks = Json::array();
  for (const FailedPoint& f : result.failed) {
    failed.push_back({{"point", f.number}, {"where", f.label}, {"error", f.error}});
  }
  for (const WarnedPoint& w : result.warned) {
    warned.push_back({{"point", w.number}, {"where", w.label}, {"warning", w.warning}});
  }
  for (const Check& c : result.checks) checks.push_back(check_json(c));
  return {{"format", "umbsim-sweep-result/1"},
          {"sweep", sweep.name},
          {"description", sweep.description},
          {"points", sweep.points},
          {"done", result.done},
          {"missing", result.missing},
          {"failed", std::move(failed)},
          {"warned", std::move(warned)},
          {"checks", std::move(checks)}};
}

}  // namespace umbsim
