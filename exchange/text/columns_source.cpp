#include "exchange/text/columns_source.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.h"
#include "exchange/text/pose_columns.h"
#include "exchange/text/sum_or_step.h"

namespace umbsim::exchange {

ColumnsSource::ColumnsSource(Table table, const ImportOptions& options)
    : columns_(std::move(table)), options_(options) {}

std::size_t ColumnsSource::time_column() const {
  std::vector<std::size_t> candidates = columns_.of(Role::time);
  // PlotJuggler's common clock stands beside the messages' own stamps; else the first word is the file's own.
  const auto clock = std::find_if(candidates.begin(), candidates.end(), [&](std::size_t c) {
    return columns_.name(c) == "__time" || columns_.name(c) == "time_s" || columns_.name(c) == "time";
  });
  if (clock != candidates.end()) candidates = {*clock};
  return columns_.choose(candidates, options_.time_column, "--time-column", "the time");
}

// Of a wheel's columns: counts and angles rather than speeds, which must be summed up.
std::size_t ColumnsSource::wheel_column(Role role, const std::string& wanted, const std::string& option,
                                        const std::string& what) const {
  std::vector<std::size_t> candidates = columns_.of(role);
  if (!options_.encoders.empty()) {
    std::erase_if(candidates, [&](std::size_t c) { return columns_.name(c).find(options_.encoders) != 0; });
  }
  const auto is_speed = [&](std::size_t c) {
    const ColumnMeaning& m = columns_.meaning(c);
    const auto unit = wheel_unit(m.unit);
    return unit ? is_rate(*unit) : m.rate;
  };
  if (std::any_of(candidates.begin(), candidates.end(), [&](std::size_t c) { return !is_speed(c); })) {
    std::erase_if(candidates, is_speed);
  }
  return columns_.choose(candidates, wanted, option, what);
}

WheelSignal ColumnsSource::wheel(std::size_t column, std::size_t time, std::int64_t time_ns) const {
  const Table& table = columns_.table();
  const ColumnMeaning& m = columns_.meaning(column);
  WheelSignal signal;
  signal.name = columns_.name(column);
  const std::string said = options_.unit.empty() ? m.unit : options_.unit;
  const auto unit = wheel_unit(said);
  if (!unit) {
    throw InputError(fmt::format("{}: the unit of column '{}' cannot be told: give --unit {}", table.file(),
                                 signal.name, fmt::join(wheel_unit_names(), ", ")));
  }
  signal.unit = *unit;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    if (table.is_blank(row, column)) continue;
    const Nanoseconds at = table.time(row, time, time_ns);
    if (!signal.at.empty() && at <= signal.at.back()) {
      table.fail(row, time,
                 fmt::format("'{}' does not come after the row before: times must increase", table.cell(row, time)));
    }
    signal.at.push_back(at);
    signal.value.push_back(table.number(row, column));
  }
  if (signal.at.size() < 2) table.fail_file(fmt::format("column '{}' has fewer than two numbers", signal.name));
  signal.per_sample = !is_rate(signal.unit) && is_per_sample(signal, m.per_sample, options_.counts, table.file());
  return signal;
}

void ColumnsSource::commands(Log& log, std::size_t time, std::int64_t time_ns) const {
  const auto find = [&](Role role, const std::string& wanted, const std::string& option) -> std::optional<std::size_t> {
    const std::vector<std::size_t> all = columns_.of(role);
    if (wanted.empty() && all.size() != 1) return std::nullopt;
    return columns_.choose(all, wanted, option, "a command");
  };
  const auto left = find(Role::left_command, options_.left_command_column, "--left-command");
  const auto right = find(Role::right_command, options_.right_command_column, "--right-command");
  if (!left || !right) return;
  const auto unit_of = [&](std::size_t c) { return wheel_unit(columns_.meaning(c).unit); };
  if (!unit_of(*left) || !is_rate(*unit_of(*left)) || !unit_of(*right)) {
    log.found.push_back(fmt::format("commands: columns '{}' and '{}' left out: their names do not say a unit of speed",
                                    columns_.name(*left), columns_.name(*right)));
    return;
  }
  const auto series = [&](std::size_t column) {
    WheelSignal signal{columns_.name(column), *unit_of(column), false, {}, {}};
    for (std::size_t row = 0; row < columns_.table().rows(); ++row) {
      if (columns_.table().is_blank(row, column)) continue;
      signal.at.push_back(columns_.table().time(row, time, time_ns));
      signal.value.push_back(columns_.table().number(row, column));
    }
    return signal;
  };
  WheelSignal left_command = series(*left), right_command = series(*right);
  if (left_command.at.empty() || right_command.at.empty()) return;  // columns without a number
  log.left_command = std::move(left_command);
  log.right_command = std::move(right_command);
  log.found.push_back(fmt::format("commands: columns '{}' and '{}', {}", log.left_command->name,
                                  log.right_command->name, name(log.left_command->unit)));
}

void ColumnsSource::wheels(Log& log) const {
  log.found.push_back(
      fmt::format("{}: {} rows, {}", columns_.table().file(), columns_.table().rows(), columns_.table().dialect()));
  const std::size_t left = wheel_column(Role::left, options_.left_column, "--left-column", "the left wheel's");
  const std::size_t right = wheel_column(Role::right, options_.right_column, "--right-column", "the right wheel's");
  if (left == right) {
    throw InputError(
        fmt::format("{}: column '{}' cannot be both wheels'", columns_.table().file(), columns_.name(left)));
  }
  const std::size_t time = time_column();
  std::string how;
  const std::int64_t time_ns = columns_.time_unit_ns(time, options_.time_unit, how);
  log.found.push_back(fmt::format("time: column '{}', {}", columns_.name(time), how));
  log.left = wheel(left, time, time_ns);
  log.right = wheel(right, time, time_ns);
  for (const WheelSignal* s : {&log.left, &log.right}) {
    log.found.push_back(fmt::format("{} wheel: column '{}', {}{}", s == &log.left ? "left" : "right", s->name,
                                    name(s->unit),
                                    is_rate(s->unit) ? ", summed up over time"
                                    : s->per_sample  ? ", what each sample added"
                                                     : ", cumulative"));
  }
  commands(log, time, time_ns);
}

bool ColumnsSource::has_truth() const { return !options_.x_column.empty() || !columns_.of(Role::x).empty(); }

void ColumnsSource::truth(Log& log) const {
  const std::size_t time = time_column();
  std::string how;
  const std::int64_t time_ns = columns_.time_unit_ns(time, options_.time_unit, how);
  log.truth = track_of_columns(columns_, time, time_ns, options_, log.found);
}

}  // namespace umbsim::exchange
