#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "bench/worlds/commands/commands.h"
#include "bench/worlds/commands/spread.h"
#include "bench/worlds/learn/contacts.h"

namespace umbsim::worlds {
namespace {

void contacts(const std::vector<std::string>& folders) {
  ContactsFound all;
  for (const std::string& folder : folders) {
    const ContactsFound more = contacts_found(TrialFolder(folder));
    all.refused += more.refused;
    for (std::size_t f = 0; f < kContactFigures; ++f) {
      all.believed[f] = std::max(all.believed[f], more.believed[f]);
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
    fmt::print("| {}, {} | {:.{}f} |", figure.name, figure.unit, all.believed[f] / figure.per_unit, figure.digits);
    for (const auto& [engine, found] : all.by_engine)
      fmt::print(" {} |", spread(found[f], figure.per_unit, figure.digits));
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
