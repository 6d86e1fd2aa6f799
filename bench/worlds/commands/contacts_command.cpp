#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "bench/worlds/commands/commands.h"
#include "bench/worlds/learn/contacts.h"

namespace umbsim::worlds {
namespace {

std::string contacts_cell(std::vector<double> found, const ContactFigure& figure) {
  if (found.empty()) return "";
  double sum = 0;
  for (double& v : found) {
    sum += v * v;
    v = std::abs(v);
  }
  const auto middle = found.begin() + std::ptrdiff_t(found.size() / 2);
  std::nth_element(found.begin(), middle, found.end());
  return fmt::format("{:.{}f} ({:.{}f})", std::sqrt(sum / double(found.size())) / figure.per_unit, figure.digits,
                     *middle / figure.per_unit, figure.digits);
}

void contacts(const std::vector<std::string>& folders) {
  ContactsFound all;
  for (const std::string& folder : folders) {
    const ContactsFound more = contacts_found(TrialFolder(folder));
    all.refused += more.refused;
    for (std::size_t f = 0; f < kContactFigures; ++f) {
      if (all.believed[f].empty()) all.believed[f] = more.believed[f];
      for (const auto& [engine, found] : more.by_engine) {
        std::vector<double>& of_engine = all.by_engine[engine][f];
        of_engine.insert(of_engine.end(), found[f].begin(), found[f].end());
      }
    }
  }
  std::string head = "| what differs | believed |", rule = "|---|---|";
  for (const auto& [engine, found] : all.by_engine) {
    head += fmt::format(" {} |", engine);
    rule += "---|";
  }
  fmt::print("{}\n{}\n", head, rule);
  for (std::size_t f = 0; f < kContactFigures; ++f) {
    const ContactFigure& figure = kContactFigure[f];
    const double believed = all.believed[f].empty() ? 0 : all.believed[f].front();
    fmt::print("| {}, {} | {:.{}f} |", figure.name, figure.unit, believed / figure.per_unit, figure.digits);
    for (const auto& [engine, found] : all.by_engine) fmt::print(" {} |", contacts_cell(found[f], figure));
    fmt::print("\n");
  }
  if (all.refused > 0) fmt::print(stderr, "{} recordings that a diagnosis refuses are left out\n", all.refused);
}

}  // namespace

void add_contacts_command(CLI::App& app) {
  const auto folders = std::make_shared<std::vector<std::string>>();
  CLI::App* command = app.add_subcommand(
      "contacts",
      "How engines' contacts differ from this one's where nothing is wrong: root mean square (median) by engine");
  command->add_option("folders", *folders, "Folders of worlds, drawn and sealed")->required();
  command->callback([folders] { contacts(*folders); });
}

}  // namespace umbsim::worlds
