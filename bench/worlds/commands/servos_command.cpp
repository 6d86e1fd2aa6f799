#include <fmt/format.h>

#include <memory>

#include "bench/worlds/commands/commands.h"
#include "bench/worlds/commands/spread.h"
#include "bench/worlds/learn/servos.h"

namespace umbsim::worlds {
namespace {

std::string cell(const std::vector<ServoResponse>& responses, Eigen::Index figure) {
  std::vector<double> figures;
  for (const ServoResponse& r : responses) figures.push_back(r[figure]);
  const bool lag = figure == kServoLag;
  return spread(figures, lag || figure >= kServoFriction ? 0.001 : 0.01, lag ? 0 : 3);
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
