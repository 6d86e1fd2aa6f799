// Accuracy against cost, side by side: this simulator, plain Bullet and MuJoCo, on the same robot and course with the
// same driver, in one process on one core. Writes a table, a JSON file and an SVG plot.
#include <fmt/format.h>

#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>

#include "bench/speed/plot.h"
#include "bench/speed/tasks.h"
#include "core/progress.h"

namespace {

using namespace umbsim;
using namespace umbsim::bench;
using Json = nlohmann::ordered_json;

constexpr int kRepeats = 3;
constexpr double kBarError_m = 1e-4;

using Maker = std::function<std::unique_ptr<Engine>(const Setup&)>;

struct Contender {
  std::string name;
  std::string task;  ///< square | cable
  Maker make;
  std::vector<double> steps_s;
};

struct Row {
  const Contender* contender;
  double step_s;
  Outcome outcome;
};

constexpr const char* kOurs = "umbsim";
constexpr const char* kStock = "Bullet as it comes";
constexpr const char* kRound = "Bullet, round wheels";
constexpr const char* kDirect = "Bullet, direct solver";
constexpr const char* kMujoco = "MuJoCo";

std::unique_ptr<Engine> stock(const Setup& s) { return make_stock_bullet(s, {}); }
std::unique_ptr<Engine> round_wheels(const Setup& s) { return make_stock_bullet(s, {"sphere", "sequential", 50}); }
std::unique_ptr<Engine> direct(const Setup& s) { return make_stock_bullet(s, {"sphere", "direct", 10}); }

std::unique_ptr<Engine> mujoco_square(const Setup& s) { return make_mujoco(s, mujoco_for_square(s.step_s)); }
std::unique_ptr<Engine> mujoco_cable(const Setup& s) { return make_mujoco(s, mujoco_for_cable()); }

const std::vector<Contender>& contenders() {
  static const std::vector<Contender> all{
      {kOurs, "square", make_ours, {0.001, 0.002, 0.005, 0.01, 0.02}},
      {kStock, "square", stock, {0.0005, 0.001, 0.002, 0.005}},
      {kRound, "square", round_wheels, {0.0005, 0.001, 0.002, 0.005}},
      {kDirect, "square", direct, {0.001, 0.002, 0.005, 0.01, 0.02}},
      {kMujoco, "square", mujoco_square, {0.0005, 0.001, 0.002, 0.005, 0.01, 0.02}},
      {kOurs, "cable", make_ours, {0.0002, 0.0005, 0.001, 0.002, 0.005}},
      {kStock, "cable", stock, {0.0005, 0.001, 0.002}},
      {kRound, "cable", round_wheels, {0.0005, 0.001, 0.002}},
      {kDirect, "cable", direct, {0.0002, 0.0005, 0.001, 0.002}},
      {kMujoco, "cable", mujoco_cable, {0.0002, 0.0005, 0.001, 0.002}},
  };
  return all;
}

Outcome drive_once(const RobotModel& robot, const Contender& c, double step_s) {
  if (c.task == "cable") return cross_cable(*c.make(with_cable(robot, step_s)), robot);
  return drive_square(*c.make(flat(robot, step_s)), robot);
}

// The best of several rounds; every round takes all engines in turn, so that all meet the same machine.
std::vector<Row> measure(const RobotModel& robot) {
  std::vector<Row> rows;
  for (const Contender& c : contenders()) {
    for (const double step_s : c.steps_s) rows.push_back({&c, step_s, {}});
  }
  Progress progress("comparing engines", kRepeats * int(rows.size()));
  for (int repeat = 0; repeat < kRepeats; ++repeat) {
    for (Row& row : rows) {
      const Outcome next = drive_once(robot, *row.contender, row.step_s);
      if (repeat == 0 || next.cpu_s < row.outcome.cpu_s) row.outcome = next;
      progress.step();
    }
  }
  return rows;
}

void print(const std::vector<Row>& rows) {
  fmt::print("{:<22}{:<8}{:>9}{:>14}{:>14}{:>12}{:>14}\n", "engine", "task", "step ms", "error", "heading deg",
             "us/step", "sim s per s");
  for (const Row& r : rows) {
    const bool square = r.contender->task == "square";
    const std::string error =
        square ? fmt::format("{:.5f} mm", 1e3 * r.outcome.error) : fmt::format("{:.3f} x", r.outcome.error);
    fmt::print("{:<22}{:<8}{:>9.1f}{:>14}{:>14.4f}{:>12.2f}{:>14.0f}\n", r.contender->name, r.contender->task,
               1e3 * r.step_s, error, degrees(r.outcome.heading_error_rad), r.outcome.us_per_step(), r.outcome.speed());
  }
}

// The fastest of an engine's squares that `accept`s; nullptr if none does.
const Row* fastest(const std::vector<Row>& rows, const std::string& engine,
                   const std::function<bool(const Row&)>& accept) {
  const Row* best = nullptr;
  for (const Row& r : rows) {
    if (r.contender->name != engine || r.contender->task != "square" || !accept(r)) continue;
    if (!best || r.outcome.speed() > best->outcome.speed()) best = &r;
  }
  return best;
}

Json row_json(const Row& r) {
  return {{"engine", r.contender->name},      {"task", r.contender->task},
          {"step_s", r.step_s},               {"error", r.outcome.error},
          {"heading_error_rad", r.outcome.heading_error_rad},
          {"us_per_step", r.outcome.us_per_step()}, {"sim_s_per_s", r.outcome.speed()}};
}

// Ours is the fastest setting within the bar's error. Plain Bullet: its faster variant at 1 ms, whatever its error.
// MuJoCo: its fastest setting within the bar's error, and its fastest at least as accurate as ours.
Json figures(const std::vector<Row>& rows) {
  const auto within = [](double error_m) {
    return [error_m](const Row& r) { return r.outcome.arrived && r.outcome.error <= error_m; };
  };
  const auto at_1_ms = [](const Row& r) { return r.step_s == 0.001; };
  const Row* ours = fastest(rows, kOurs, within(kBarError_m));
  Json json;
  if (!ours) return json;
  const auto add = [&](const char* key, const Row* peer) {
    json[key] =
        peer ? Json{{"ratio", ours->outcome.speed() / peer->outcome.speed()}, {"peer", row_json(*peer)}} : Json();
  };
  json["ours"] = row_json(*ours);
  const Row *cylinders = fastest(rows, kStock, at_1_ms), *round = fastest(rows, kRound, at_1_ms);
  add("to_stock_bullet", cylinders->outcome.speed() > round->outcome.speed() ? cylinders : round);
  add("to_mujoco_within_bar", fastest(rows, kMujoco, within(kBarError_m)));
  add("to_mujoco_as_accurate", fastest(rows, kMujoco, within(ours->outcome.error)));
  const Row* most_accurate = nullptr;
  for (const Row& r : rows) {
    if (r.contender->name != kMujoco || r.contender->task != "square") continue;
    if (!most_accurate || r.outcome.error < most_accurate->outcome.error) most_accurate = &r;
  }
  add("to_mujoco_most_accurate", most_accurate);
  return json;
}

}  // namespace

int main(int argc, char** argv) {
  const RobotModel robot = load_robot(UMBSIM_ROBOTS_DIR "/labmate.urdf");
  const std::string out = argc > 1 ? argv[1] : ".";
  const std::vector<Row> rows = measure(robot);
  print(rows);
  Json json{{"format", "umbsim-bench-compare/1"}, {"figures", figures(rows)}, {"rows", Json::array()}};
  std::vector<PlotPoint> points;
  for (const Row& r : rows) {
    json["rows"].push_back(row_json(r));
    if (r.contender->task == "square") points.push_back({r.contender->name, r.outcome.speed(), 1e3 * r.outcome.error});
  }
  std::ofstream(out + "/compare.json") << json.dump(2) << "\n";
  std::ofstream(out + "/compare.svg") << accuracy_plot(points);
}
