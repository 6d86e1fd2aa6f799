// The figures and their bars, from what umbsim_engines_compare, umbsim_micro and umbsim_instructions wrote into a folder:
// prints one table, writes bench.json and the tables of docs/bench.md.
#include <algorithm>
#include <cstdio>
#include <fstream>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace {

using Json = nlohmann::ordered_json;

struct Figure {
  std::string name;
  std::string bar;
  std::string measured;
  bool met = false;
};

Json load(const std::string& file) {
  std::ifstream stream(file);
  if (!stream) throw std::runtime_error(file + " is missing");
  return Json::parse(stream);
}

// The benchmark whose name begins so.
const Json& find(const Json& micro, const std::string& name) {
  for (const Json& b : micro.at("benchmarks")) {
    if (b.at("name").get<std::string>().rfind(name + "/", 0) == 0) return b;
  }
  throw std::runtime_error("no benchmark " + name);
}

double number(const Json& json, const char* key) { return json.at(key).get<double>(); }

void add_engines(std::vector<Figure>& figures, const Json& f) {
  const double speed = number(f["ours"], "sim_s_per_s");
  figures.push_back({"flat floor, return error at most 0.1 mm after 16 m", ">= 2500 sim s/s",
                     fmt::format("{:.0f} ({:.5f} mm)", speed, 1e3 * number(f["ours"], "error")), speed >= 2500});
  const auto ratio = [&](const std::string& name, const char* key, double bar) {
    if (f[key].is_null()) return false;
    const Json& peer = f[key]["peer"];
    const double r = number(f[key], "ratio");
    figures.push_back({name, fmt::format(">= {:.0f} x", bar),
                       fmt::format("{:.0f} x ({:.0f} sim s/s, {:g} ms, {:.5f} mm)", r, number(peer, "sim_s_per_s"),
                                   1e3 * number(peer, "step_s"), 1e3 * number(peer, "error")),
                       r >= bar});
    return true;
  };
  ratio("against plain Bullet, default solver, 1 ms", "to_stock_bullet", 35);
  ratio("against MuJoCo's fastest setting within 0.1 mm", "to_mujoco_within_bar", 10);
  if (!ratio("against MuJoCo, at least as accurate as ours", "to_mujoco_as_accurate", 10)) {
    ratio("against MuJoCo's most accurate setting (ours is more accurate)", "to_mujoco_most_accurate", 10);
  }
}

void add_cases(std::vector<Figure>& figures, const Json& micro) {
  const Json& cable = find(micro, "cable/step_us:1000");
  const double ratio = number(cable, "ratio_to_closed_form"), cable_speed = number(cable, "sim_s_per_s");
  figures.push_back({"10 mm cable, 1 ms throughout, heading within 3 % of the closed form", ">= 500 sim s/s",
                     fmt::format("{:.0f} ({:+.1f} %)", cable_speed, 100 * (ratio - 1)),
                     cable_speed >= 500 && std::abs(ratio - 1) <= 0.03});
  const Json &slow = find(micro, "cable_grid/speed_mmps:20"), &faster = find(micro, "cable_grid/speed_mmps:50");
  const double least = std::min(number(slow, "least_ratio"), number(faster, "least_ratio"));
  const double most = std::max(number(slow, "most_ratio"), number(faster, "most_ratio"));
  const double grid_speed = std::min(number(slow, "sim_s_per_s"), number(faster, "sim_s_per_s"));
  figures.push_back({"cables, whole grid, 1 ms, heading within 3 % of the closed form", ">= 500 sim s/s",
                     fmt::format("{:.0f} ({:+.1f} % to {:+.1f} %)", grid_speed, 100 * (least - 1), 100 * (most - 1)),
                     grid_speed >= 500 && least >= 0.97 && most <= 1.03});
  for (const auto& [key, name] : {std::pair{"caster", "swivelling caster"}, std::pair{"uneven", "uneven floor"}}) {
    const Json& b = find(micro, std::string(key) + "/step_us:20000");
    const double speed = number(b, "sim_s_per_s");
    figures.push_back({fmt::format("{}, 20 ms; error to a ten times smaller step", name), ">= 800 sim s/s",
                       fmt::format("{:.0f} ({:.4f} mm, {:.5f} deg)", speed, number(b, "error_to_finer_mm"),
                                   number(b, "error_to_finer_deg")),
                       speed >= 800});
  }
}

void add_programs(std::vector<Figure>& figures, const Json& micro) {
  const Json &umbmark = find(micro, "umbmark"), &sweep = find(micro, "sweep");
  const double two_s = number(umbmark, "two_cores_s"), scaling = number(sweep, "scaling");
  figures.push_back({"ten-run LabMate UMBmark, two cores, whole program", "<= 0.3 s",
                     fmt::format("{:.2f} s (one core {:.2f} s)", two_s, number(umbmark, "one_core_s")), two_s <= 0.3});
  figures.push_back({"200-run sweep, from one core to two", ">= 1.9 x",
                     fmt::format("{:.2f} x ({:.1f} s, {:.1f} s)", scaling, number(sweep, "one_core_s"),
                                 number(sweep, "two_cores_s")),
                     scaling >= 1.9});
  const double peak = number(sweep, "peak_mib");
  figures.push_back({"200-run sweep, peak memory", "<= 200 MiB", fmt::format("{:.0f} MiB", peak), peak <= 200});
}

void add_instructions(std::vector<Figure>& figures, const Json& instructions) {
  std::string text;
  for (const auto& [name, count] : instructions.at("instructions_per_simulated_s").items()) {
    text += fmt::format("{}{} {:.2f}", text.empty() ? "" : ", ", name, count.get<double>() / 1e6);
  }
  figures.push_back({"million instructions per simulated second", "recorded, tested", text, true});
}

std::string markdown(const std::vector<Figure>& figures) {
  std::string text = "| figure | bar | measured | met |\n|---|---|---|---|\n";
  for (const Figure& f : figures) {
    text += fmt::format("| {} | {} | {} | {} |\n", f.name, f.bar, f.measured, f.met ? "yes" : "no");
  }
  return text;
}

std::string engines_markdown(const Json& compare) {
  std::string text =
      "| engine | task | step | error | µs per step | simulated s per s |\n|---|---|---|---|---|---|\n";
  for (const Json& r : compare.at("rows")) {
    const double error = number(r, "error");
    const std::string shown = r["task"] == "square" ? fmt::format("{:.5f} mm", 1e3 * error)
                                                    : fmt::format("{:.2f} × closed form", error);
    text += fmt::format("| {} | {} | {:g} ms | {} | {:.1f} | {:.0f} |\n", r["engine"].get<std::string>(),
                        r["task"].get<std::string>(), 1e3 * number(r, "step_s"), shown, number(r, "us_per_step"),
                        number(r, "sim_s_per_s"));
  }
  return text;
}

std::string steps_markdown(const Json& micro) {
  std::string text = "| case | step | µs per step | simulated s per s | error to a ten times smaller step |\n"
                     "|---|---|---|---|---|\n";
  for (const Json& b : micro.at("benchmarks")) {
    if (!b.contains("us_per_step")) continue;
    const std::string name = b["name"];
    double step_us = 0, fine_us = 0;
    std::sscanf(name.c_str() + name.find('/'), "/step_us:%lf/fine_step_us:%lf", &step_us, &fine_us);
    const std::string step = step_us == fine_us
                                 ? fmt::format("{:g} ms", step_us / 1e3)
                                 : fmt::format("{:g} ms, near the cable {:g} ms", step_us / 1e3, fine_us / 1e3);
    const std::string position =
        b.contains("error_to_finer_mm") ? fmt::format("{:.5f} mm, ", number(b, "error_to_finer_mm")) : "";
    text += fmt::format("| {} | {} | {:.2f} | {:.0f} | {}{:.5f}° |\n", name.substr(0, name.find('/')), step,
                        number(b, "us_per_step"), number(b, "sim_s_per_s"), position, number(b, "error_to_finer_deg"));
  }
  return text;
}

std::string processor() {
  std::ifstream stream("/proc/cpuinfo");
  for (std::string line; std::getline(stream, line);) {
    if (line.rfind("model name", 0) == 0) return line.substr(line.find(": ") + 2);
  }
  return "unknown";
}

Json result_json(const std::vector<Figure>& figures, const Json& compare, const Json& micro, const Json& instructions) {
  Json json{{"format", "umbsim-bench/1"},
            {"machine", {{"processor", processor()}, {"cores", std::thread::hardware_concurrency()}}},
            {"compiler", __VERSION__}};
  for (const Figure& f : figures) {
    json["figures"].push_back({{"figure", f.name}, {"bar", f.bar}, {"measured", f.measured}, {"met", f.met}});
  }
  json["engines"] = compare.at("rows");
  for (Json b : micro.at("benchmarks")) {
    for (const char* key : {"family_index", "per_family_instance_index", "run_name", "run_type", "repetitions",
                            "repetition_index", "threads", "cpu_time", "real_time", "time_unit"}) {
      b.erase(key);
    }
    json["cases"].push_back(b);
  }
  json["instructions"] = instructions;
  return json;
}

void print(const std::vector<Figure>& figures) {
  fmt::print("{:<68}{:<20}{:<46}{}\n", "figure", "bar", "measured", "met");
  for (const Figure& f : figures) fmt::print("{:<68}{:<20}{:<46}{}\n", f.name, f.bar, f.measured, f.met ? "yes" : "NO");
}

}  // namespace

int main(int argc, char** argv) {
  const std::string folder = argc > 1 ? argv[1] : ".";
  try {
    const Json compare = load(folder + "/compare.json"), micro = load(folder + "/micro.json"),
               instructions = load(folder + "/instructions.json");
    std::vector<Figure> figures;
    add_engines(figures, compare.at("figures"));
    add_cases(figures, micro);
    add_programs(figures, micro);
    add_instructions(figures, instructions);
    print(figures);
    std::ofstream(folder + "/bench.json") << result_json(figures, compare, micro, instructions).dump(2) << "\n";
    std::ofstream(folder + "/figures.md") << markdown(figures);
    std::ofstream(folder + "/engines.md") << engines_markdown(compare);
    std::ofstream(folder + "/steps.md") << steps_markdown(micro);
  } catch (const std::exception& e) {
    fmt::print(stderr, "umbsim_bench_table: {}\n", e.what());
    return 1;
  }
}
