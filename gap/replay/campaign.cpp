#include "gap/replay/campaign.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.h"

namespace umbsim::gap {
namespace {

void must_agree(const std::string& key, double first, double other, const std::string& first_name,
                const std::string& other_name) {
  if (first == other) return;
  throw InputError(
      fmt::format("{}: robot.{} is {}, but {} in {}: recordings that are diagnosed together are of one robot, "
                  "and state the same of it",
                  other_name, key, other, first, first_name));
}

void must_be_one_robot(const Recording& first, const Recording& other, const std::string& first_name,
                       const std::string& other_name) {
  const RecordedRobot& a = first.robot;
  const RecordedRobot& b = other.robot;
  must_agree("wheel_radius_m", a.wheel_radius_m, b.wheel_radius_m, first_name, other_name);
  must_agree("wheelbase_m", a.wheelbase_m, b.wheelbase_m, first_name, other_name);
  must_agree("ticks_per_revolution", a.ticks_per_revolution, b.ticks_per_revolution, first_name, other_name);
  if (a.urdf != b.urdf || a.urdf_text != b.urdf_text)
    throw InputError(
        fmt::format("{}: robot.urdf is not that of {}: recordings that are diagnosed together are of one robot",
                    other_name, first_name));
}

// What a part's run feels of effects on the whole campaign: what happens in one run is named by that run.
std::vector<Effect> for_part(const Campaign& campaign, std::size_t run, const std::vector<Effect>& effects) {
  const std::string& name = campaign.all.runs[run].id;
  std::vector<Effect> felt;
  for (Effect e : effects) {
    if (e.info->one_run && !e.values.run.empty()) {
      if (e.values.run != name) continue;
      e.values.run = campaign.of(run).runs[campaign.within(run)].id;
    }
    felt.push_back(std::move(e));
  }
  return felt;
}

}  // namespace

std::size_t Campaign::within(std::size_t run) const {
  return std::size_t(std::count(part_of.begin(), part_of.begin() + std::ptrdiff_t(run), part_of[run]));
}

bool Campaign::all_tracked() const {
  return std::all_of(parts.begin(), parts.end(), [](const Recording& r) { return r.truth_kind == "track"; });
}

Campaign campaign_of(Recording recording) {
  Campaign campaign{recording, {}, std::vector<std::size_t>(recording.runs.size(), 0)};
  campaign.parts.push_back(std::move(recording));
  return campaign;
}

Campaign joined(std::vector<Recording> recordings, const std::vector<std::string>& names) {
  if (recordings.size() == 1) return campaign_of(std::move(recordings.front()));
  Campaign campaign;
  campaign.all = recordings.front();
  campaign.all.runs.clear();
  for (std::size_t i = 0; i < recordings.size(); ++i) {
    must_be_one_robot(recordings.front(), recordings[i], names.front(), names[i]);
    for (const RecordedRun& run : recordings[i].runs) {
      campaign.all.runs.push_back(run);
      campaign.all.runs.back().id = names[i] + "/" + run.id;
      campaign.part_of.push_back(i);
    }
    if (i > 0) campaign.all.title += " + " + recordings[i].title;
  }
  campaign.parts = std::move(recordings);
  return campaign;
}

std::size_t leading_part(const Campaign& campaign) {
  for (std::size_t i = 0; i < campaign.parts.size(); ++i) {
    const auto& runs = campaign.parts[i].runs;
    if (std::any_of(runs.begin(), runs.end(), [](const RecordedRun& r) { return r.has_commands; })) return i;
  }
  return 0;
}

Simulator joined(const Campaign& campaign, std::vector<Simulator> simulators) {
  if (!campaign.several()) return std::move(simulators.front());
  const Simulator& lead = simulators[leading_part(campaign)];
  Simulator all = lead;
  all.ticks = [&campaign, simulators](std::size_t run, const std::vector<Effect>& effects, double roughness) {
    const Simulator& own = simulators[campaign.part_of[run]];
    return own.ticks(campaign.within(run), for_part(campaign, run, effects), roughness);
  };
  if (lead.commands) {
    all.commands = [&campaign, simulators](std::size_t run, const std::vector<Effect>& effects) {
      const Simulator& own = simulators[campaign.part_of[run]];
      return own.commands(campaign.within(run), for_part(campaign, run, effects));
    };
  }
  return all;
}

}  // namespace umbsim::gap
