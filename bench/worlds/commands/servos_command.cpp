#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "bench/worlds/commands/commands.h"
#include "bench/worlds/learn/servos.h"

namespace umbsim::worlds {
namespace {

double root_mean_square(const std::vector<ServoResponse>& responses, double ServoResponse::*of) {
  double sum = 0;
  for (const ServoResponse& r : responses) sum += std::pow(r.*of, 2);
  return std::sqrt(sum / double(responses.size()));
}

double median_size(const std::vector<ServoResponse>& responses, double ServoResponse::*of) {
  std::vector<double> sizes;
  for (const ServoResponse& r : responses) sizes.push_back(std::abs(r.*of));
  const auto middle = sizes.begin() + std::ptrdiff_t(sizes.size() / 2);
  std::nth_element(sizes.begin(), middle, sizes.end());
  return *middle;
}

std::string cell(const std::vector<ServoResponse>& responses, double ServoResponse::*of) {
  const bool lag = of == &ServoResponse::lag_s;
  const double unit = lag ? 1000 : 100;
  const int digits = lag ? 0 : 3;
  return fmt::format("{:.{}f} ({:.{}f})", unit * root_mean_square(responses, of), digits,
                     unit * median_size(responses, of), digits);
}

void servos(const std::vector<std::string>& folders) {
  std::map<std::string, std::vector<ServoResponse>> by_engine;
  for (const std::string& folder : folders) {
    for (auto& [engine, responses] : servo_responses(TrialFolder(folder)))
      by_engine[engine].insert(by_engine[engine].end(), responses.begin(), responses.end());
  }
  fmt::print("| engine | cases | both wheels, % | left over right, % | lag, ms | along the course, % | across, % |\n");
  fmt::print("|---|---|---|---|---|---|---|\n");
  for (const auto& [engine, responses] : by_engine) {
    fmt::print("| {} | {} |", engine, responses.size());
    for (const auto of : kServoFigures) fmt::print(" {} |", cell(responses, of));
    fmt::print("\n");
  }
}

}  // namespace

void add_servos_command(CLI::App& app) {
  const auto folders = std::make_shared<std::vector<std::string>>();
  CLI::App* command = app.add_subcommand(
      "servos",
      "How engines' counts follow commands where nothing acts on either: root mean square (median) by engine");
  command->add_option("folders", *folders, "Folders of worlds, drawn and sealed")->required();
  command->callback([folders] { servos(*folders); });
}

}  // namespace umbsim::worlds
