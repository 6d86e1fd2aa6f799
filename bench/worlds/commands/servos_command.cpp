#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "bench/worlds/commands/commands.h"
#include "bench/worlds/learn/servos.h"

namespace umbsim::worlds {
namespace {

double root_mean_square(const std::vector<ServoResponse>& responses, Eigen::Index figure) {
  double sum = 0;
  for (const ServoResponse& r : responses) sum += r[figure] * r[figure];
  return std::sqrt(sum / double(responses.size()));
}

double median_size(const std::vector<ServoResponse>& responses, Eigen::Index figure) {
  std::vector<double> sizes;
  for (const ServoResponse& r : responses) sizes.push_back(std::abs(r[figure]));
  const auto middle = sizes.begin() + std::ptrdiff_t(sizes.size() / 2);
  std::nth_element(sizes.begin(), middle, sizes.end());
  return *middle;
}

std::string cell(const std::vector<ServoResponse>& responses, Eigen::Index figure) {
  const bool lag = figure == kServoLag;
  const double unit = lag || figure >= kServoFriction ? 1000 : 100;
  const int digits = lag ? 0 : 3;
  return fmt::format("{:.{}f} ({:.{}f})", unit * root_mean_square(responses, figure), digits,
                     unit * median_size(responses, figure), digits);
}

void servos(const std::vector<std::string>& folders) {
  std::map<std::string, std::vector<ServoResponse>> by_engine;
  int refused = 0;
  for (const std::string& folder : folders) {
    const ServoResponses more = servo_responses(TrialFolder(folder));
    refused += more.refused;
    for (const auto& [engine, responses] : more.by_engine)
      by_engine[engine].insert(by_engine[engine].end(), responses.begin(), responses.end());
  }
  fmt::print(
      "| engine | cases | both wheels, % | left over right, % | lag, ms | along the course, % | across, % | "
      "friction on the way, ms | in place, ms |\n");
  fmt::print("|---|---|---|---|---|---|---|---|---|\n");
  for (const auto& [engine, responses] : by_engine) {
    fmt::print("| {} | {} |", engine, responses.size());
    for (Eigen::Index figure = 0; figure < ServoResponse::RowsAtCompileTime; ++figure)
      fmt::print(" {} |", cell(responses, figure));
    fmt::print("\n");
  }
  if (refused > 0) fmt::print(stderr, "{} recordings that a diagnosis refuses are left out\n", refused);
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
