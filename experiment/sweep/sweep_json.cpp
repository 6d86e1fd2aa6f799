#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>

#include "experiment/output/build_info.h"
#include "experiment/sweep/sweep_result.h"

namespace umbsim {
namespace {

// So many numbers at most go into the page: some 4 MB.
constexpr std::int64_t kPageNumbers = 400000;

// Beginnings of the figures that stay where the page would grow too large.
constexpr const char* kMain[] = {
    "umbmark.e_max_syst_m",    "umbmark.cw.r_cg_m",      "umbmark.ccw.r_cg_m", "injected.",
    "calibration.endpoint.e_", "calibration.heading.e_", "recovery.e_",        "recovery.improvement",
    "extended.mean_abs",       "extended.per_bump"};

// Recovered against injected has a picture of its own, whether they vary or not.
constexpr const char* kAlways[] = {"injected.", "calibration.endpoint.e_", "calibration.heading.e_"};

template <std::size_t N>
bool begins_with_any(const std::string& figure, const char* const (&beginnings)[N]) {
  return std::any_of(std::begin(beginnings), std::end(beginnings),
                     [&](const char* begin) { return figure.rfind(begin, 0) == 0; });
}

// The figures that say anything: those that are not the same at all points.
std::vector<std::string> varied_figures(Store& store) {
  const std::vector<std::string>& all = store.layout().figures;
  std::vector<std::string> varied;
  std::vector<std::size_t> open(all.size());
  for (std::size_t i = 0; i < all.size(); ++i) open[i] = i;
  std::vector<Cell> first;
  std::vector<bool> differs(all.size(), false);
  Statement rows = store.select(all, {}, "report");
  while (!open.empty() && rows.step()) {
    if (first.empty()) {
      for (std::size_t i = 0; i < all.size(); ++i) first.push_back(rows.cell(int(i)));
    }
    std::erase_if(open, [&](std::size_t i) { return differs[i] = rows.cell(int(i)) != first[i]; });
  }
  for (std::size_t i = 0; i < all.size(); ++i) {
    const bool always = !first.empty() && is_number(first[i]) && begins_with_any(all[i], kAlways);
    if (differs[i] || always) varied.push_back(all[i]);
  }
  return varied;
}

// Seven digits are more than a picture shows.
Json page_number(const Cell& cell) {
  if (const auto* text = std::get_if<std::string>(&cell)) return *text;
  const double value = number_of(cell);
  return std::isfinite(value) ? Json(std::strtod(fmt::format("{:.7g}", value).c_str(), nullptr)) : Json();
}

Json axes_json(const Sweep& sweep) {
  Json axes = Json::array();
  for (const Axis& axis : sweep.axes) {
    Json json{{"key", axis.key}, {"log", axis.logarithmic}};
    axes.push_back(std::move(json));
  }
  if (sweep.replicates > 1) axes.push_back({{"key", "replicate"}, {"log", false}});
  return axes;
}

// Numbers of the expectations that a point does not meet.
std::map<std::int64_t, Json> unmet_of(const SweepResult& result) {
  std::map<std::int64_t, Json> unmet;
  for (std::size_t i = 0; i < result.checks.size(); ++i) {
    for (const Outcome& o : result.checks[i].outcomes) {
      if (!o.met && o.point >= 0) unmet[o.point].push_back(i);
    }
  }
  return unmet;
}

Json rows_json(Store& store, const std::vector<std::string>& columns, std::int64_t stride, const SweepResult& result) {
  std::vector<std::string> wanted{"point", "status"};
  wanted.insert(wanted.end(), columns.begin(), columns.end());
  const std::map<std::int64_t, Json> unmet = unmet_of(result);
  Json list = Json::array();
  Statement rows = store.select(wanted, {}, "report");
  for (std::int64_t i = 0; rows.step(); ++i) {
    if (i % stride != 0) continue;
    Json row{{"point", rows.integer(0)}};
    if (rows.text(1) == "failed") row["failed"] = true;
    if (const auto u = unmet.find(rows.integer(0)); u != unmet.end()) row["unmet"] = u->second;
    row["v"] = Json::array();
    for (int c = 2; c < rows.columns(); ++c) row["v"].push_back(page_number(rows.cell(c)));
    list.push_back(std::move(row));
  }
  return list;
}

}  // namespace

Json sweep_report_json(const Sweep& sweep, Store& store, const SweepResult& result) {
  std::vector<std::string> figures = varied_figures(store);
  const std::int64_t points = result.done + std::int64_t(result.failed.size());
  if (points * std::int64_t(figures.size()) > kPageNumbers)
    std::erase_if(figures, [](const auto& f) { return !begins_with_any(f, kMain); });
  const std::int64_t stride = 1 + points * std::int64_t(figures.size() + sweep.axes.size()) / kPageNumbers;
  std::vector<std::string> columns;
  for (const Axis& axis : sweep.axes) columns.push_back(axis.key);
  if (sweep.replicates > 1) columns.push_back("replicate");
  columns.insert(columns.end(), figures.begin(), figures.end());
  Json json = sweep_json(sweep, result);
  json["title"] = sweep.name;
  json["version"] = build_info().version;
  json["design"] = name(sweep.design);
  json["axes"] = axes_json(sweep);
  json["figures"] = figures;
  json["view"] = {
      {"x", sweep.view.x}, {"y", sweep.view.y}, {"figure", sweep.view.figure}, {"log", sweep.view.logarithmic}};
  json["stride"] = stride;
  json["rows"] = rows_json(store, columns, stride, result);
  return json;
}

}  // namespace umbsim
