#include "cli/output/import_text.h"

#include <fmt/format.h>

#include <cmath>

#include "core/text/printable.h"
#include "core/text/wrapped_text.h"
#include "gap/noise/clock.h"

namespace umbsim {
namespace {

// How the clocks stand to each other; they stay as they are in the recording.
struct Clock {
  double offset_s, offset_sd_s;
  bool known;
};

Clock clock_of(const RecordedRun& run, const RecordedRobot& robot) {
  const gap::ClockFit fit = gap::fit_clock(run, robot);
  const double middle = (run.truth.front().time_s + run.truth.back().time_s) / 2;
  const Clock clock{fit.offset_s + fit.rate * middle, fit.offset_sd_s, std::isfinite(fit.offset_sd_s)};
  constexpr double kBest_s = 0.2;  // a wider answer is none
  return {clock.offset_s, clock.offset_sd_s,
          clock.known && clock.offset_sd_s < kBest_s && std::abs(clock.offset_s) < 2};
}

std::string run_row(const exchange::Piece& p, const RecordedRun& run, const RecordedRobot& robot) {
  const Clock clock = clock_of(run, robot);
  const std::string offset = clock.known ? fmt::format("{:+.0f} ms", 1000 * clock.offset_s) : "-";
  return fmt::format("  {}{:>5}{:>9.2f}{:>9.2f}{:>9.3f}{:>9.1f}{:>7}{:>7}{:>9}\n", fitted(p.id, 14), p.direction,
                     p.from_s, p.to_s, p.way_m, degrees(p.turn_rad), run.encoders.size(), run.truth.size(), offset);
}

}  // namespace

std::string import_text(const exchange::Imported& i) {
  const Recording& r = i.recording;
  std::string text = wrapped(fmt::format("{}: what was found", r.title));
  for (const std::string& line : i.found) text += wrapped("  " + printable(line), 4);
  text +=
      wrapped(fmt::format("  header: wheel radius {:g} m, wheelbase {:g} m, {:g} ticks per revolution, {:g} Hz",
                          r.robot.wheel_radius_m, r.robot.wheelbase_m, r.robot.ticks_per_revolution, r.encoder_rate_hz),
              4);
  text += wrapped(
      fmt::format("Runs ({}{}):", i.cut.how, r.path.shape == "square" ? fmt::format(" of {:g} m", r.path.side_m) : ""));
  text += fmt::format("  {:<14}{:>5}{:>9}{:>9}{:>9}{:>9}{:>7}{:>7}{:>9}\n", "", "", "from s", "to s", "way m",
                      "turn deg", "counts", "poses", "clock");
  for (std::size_t k = 0; k < r.runs.size(); ++k) text += run_row(i.cut.pieces[k], r.runs[k], r.robot);
  text += wrapped(
      "  clock: encoders' less truth's, estimated where both turn; reported only, the times stay as they are", 4);
  for (const std::string& line : i.cut.left_out) text += wrapped("Left out: " + line);
  for (const std::string& line : i.remarks) text += wrapped("Look at: " + line);
  for (const std::string& line : i.limits) text += wrapped("Limit: " + line);
  return text;
}

Json import_json(const exchange::Imported& i) {
  Json runs = Json::array();
  for (std::size_t k = 0; k < i.cut.pieces.size(); ++k) {
    const exchange::Piece& p = i.cut.pieces[k];
    const Clock clock = clock_of(i.recording.runs[k], i.recording.robot);
    Json run{{"id", p.id},       {"direction", p.direction}, {"from_s", p.from_s}, {"to_s", p.to_s},
             {"way_m", p.way_m}, {"turn_rad", p.turn_rad},   {"clock", nullptr}};
    if (clock.known) run["clock"] = {{"offset_s", clock.offset_s}, {"offset_sd_s", clock.offset_sd_s}};
    runs.push_back(run);
  }
  return {{"format", "umbsim-import/1"},
          {"source", i.recording.source},
          {"found", i.found},
          {"cut", i.cut.how},
          {"runs", runs},
          {"left_out", i.cut.left_out},
          {"remarks", i.remarks},
          {"limits", i.limits}};
}

}  // namespace umbsim
