#include "gap/traits/traits.h"

#include <algorithm>
#include <map>
#include <vector>

namespace umbsim::gap {
namespace {

// clang-format off
const std::vector<Traits>& table() {
  static const std::vector<Traits> all{
      {"wheel_radius_scale", "legs", kKinematic | kDimension, kRadius},
      {"wheel_radius_difference", "legs", kKinematic | kDimension, kRadius},
      {"wheelbase", "turns", kKinematic | kDimension},
      // Toed wheels scrub: the yaw that it takes differs between tyres.
      {"wheel_misalignment", "legs", kScrubs, kNothing, 0.25, kSlip | kRadius},
      {"wheel_eccentricity", "wheel_angle"},
      {"load_shift", "load"},
      {"wear", "runs", kKinematic | kByRun, kRadius},
      {"backlash", "reversals", 0, kPlay},
      {"motor_response", "commands", kKinematic},
      {"over_acceleration", "leg_start", kCommandedMotion, kNothing, 0, kNothing, {0}},
      {"fast_turning", "turns", kCommandedMotion, kNothing, 0, kNothing, {2}},
      // Coarse or rare counts are undone as well as can be. What is left are jumps of the shafts' speed.
      {"encoder_resolution", "legs", 0, kNothing, 0.1, kSlip | kPlay, {.feature = 4, .below = -0.1}},
      {"encoder_sampling", "turns", kKinematic | kFromWhatShows, kNothing, 0.1, kSlip | kPlay, {.feature = 3, .above = 0}},
      // Counts that get lost look like another radius, and so does what chance takes from them.
      {"encoder_missed_counts", "legs", kKinematic | kByChance, kNothing, 0.02, kRadius},
      {"encoder_latency", "speed", kKinematic, kPlay},
      {"tyre_compliance", "load", kKinematic},
      {"contact_patch", "turns", kLikeADimension},
      {"tyre_creep", "leg_start", 0, kSlip},
      {"caster_swivel", "leg_start", 0, kCaster},
      {"caster_drag", "legs", 0, kCaster},
      // A robot that is driven too hard slips on ordinary floors, too.
      {"slippery_floor", "turns", kThreshold, kSlip, 0, kNothing, {}, kOrdinaryFriction},
      {"slippery_patch", "place", kOfAPlace | kDisc | kThreshold, kPlace},
      {"bump", "place", kOfAPlace},
      {"uneven_floor", "place"},
      {"floor_slope", "world_direction", kOfADirection},
      {"carpet_drift", "world_direction", kOfADirection},
      {"push", "one_run", kOfAPlace, kPlace},
      {"wheel_lift", "place", kOfAPlace | kDisc, kPlace},
  };
  return all;
}
// clang-format on

}  // namespace

const Traits& traits_of(const std::string& effect) {
  static const std::map<std::string, const Traits*> by_name = [] {
    std::map<std::string, const Traits*> map;
    for (const Traits& t : table()) map.emplace(t.effect, &t);
    return map;
  }();
  static const Traits none{};
  const auto found = by_name.find(effect);
  return found == by_name.end() ? none : *found->second;
}

bool shows_in_counts(const EffectInfo& info) {
  return info.stage == Stage::drivetrain || info.stage == Stage::encoder || is_commanded_motion(info.name);
}

std::vector<Effect> reaching_counts(std::vector<Effect> effects) {
  const bool gives_way =
      std::any_of(effects.begin(), effects.end(), [](const Effect& e) { return e.info->stage == Stage::drivetrain; });
  if (!gives_way) std::erase_if(effects, [](const Effect& e) { return !shows_in_counts(*e.info); });
  return effects;
}

bool is_contact(const std::string& effect) {
  const EffectInfo& info = find_effect(effect);
  const bool of_contact = info.stage == Stage::contact || info.stage == Stage::floor;
  return of_contact && !is_kinematic(effect) && !shows_in_counts(info);
}

}  // namespace umbsim::gap
