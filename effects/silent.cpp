#include "effects/silent.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace umbsim {
namespace {

// Bindings, not members by name: a member that is added and forgotten here does not compile.
bool same(const Inertial& a, const Inertial& b) {
  const auto& [mass, com, inertia] = a;
  return mass == b.mass_kg && com == b.com_m && inertia == b.inertia_kgm2;
}

bool same(const Wheel& a, const Wheel& b) {
  const auto& [joint, centre, axis, radius, width, eccentricity, phase, mass, spin, transverse, effort, compliance,
               along, across, slip_along, slip_across, patch, along_joint, slide, suspension] = a;
  return joint == b.joint && centre == b.centre_m && axis == b.axis && radius == b.radius_m && width == b.width_m &&
         eccentricity == b.eccentricity_m && (eccentricity == 0 || phase == b.eccentricity_rad) && mass == b.mass_kg &&
         spin == b.spin_inertia_kgm2 && transverse == b.transverse_inertia_kgm2 && effort == b.effort_limit_nm &&
         compliance == b.compliance_mpn && along == b.creep_along && across == b.creep_across &&
         slip_along == b.slip_along_mps_per_n && slip_across == b.slip_across_mps_per_n && patch == b.patch_width_m &&
         along_joint == b.along_joint_m && slide == b.slide && suspension == b.suspension;
}

bool same(const Caster& a, const Caster& b) {
  const auto& [link, centre, radius, friction, swivels, point, fork, mass, spin, transverse, swivel, creep, angle,
               slide, suspension] = a;
  return link == b.link && centre == b.centre_m && radius == b.radius_m && friction == b.friction &&
         swivels == b.swivels && point == b.swivel_point_m && same(fork, b.fork) && mass == b.wheel_mass_kg &&
         spin == b.wheel_spin_inertia_kgm2 && transverse == b.wheel_transverse_inertia_kgm2 &&
         swivel == b.swivel_friction_nm && (swivel == 0 || creep == b.bearing_creep) && angle == b.initial_angle_rad &&
         slide == b.slide && suspension == b.suspension;
}

bool same(const Motor& a, const Motor& b) {
  const auto& [torque, gain, lag, droop, deadband, backlash] = a;
  return torque == b.torque_limit_nm && gain == b.gain && lag == b.lag_s && droop == b.droop_radps_per_nm &&
         deadband == b.deadband_radps && backlash == b.backlash_rad;
}

bool same(const CommandedMotion& a, const CommandedMotion& b) {
  const auto& [acceleration, turn] = a;
  return acceleration == b.acceleration_factor && turn == b.turn_speed_factor;
}

template <class Item>
bool all_same(const Item& a, const Item& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& x, const auto& y) { return same(x, y); });
}

// What lies on a floor is only ever added.
bool same(const Floor& a, const Floor& b) {
  const auto& [friction, ripples, cables, patches, slope, downhill, drift_x, drift_y] = a;
  // A level floor falls nowhere, whatever direction is given.
  return friction == b.friction && ripples.size() == b.ripples.size() && cables.size() == b.cables.size() &&
         patches.size() == b.patches.size() && slope == b.slope_rad && (slope == 0 || downhill == b.downhill_rad) &&
         drift_x == b.drift_x && drift_y == b.drift_y;
}

bool same(const Rig& a, const Rig& b) {
  const auto& [robot, drivetrain, encoders, floor, commanded_motion, pushes, run] = a;
  return same(robot.base, b.robot.base) && all_same(robot.wheels, b.robot.wheels) &&
         all_same(robot.casters, b.robot.casters) && all_same(drivetrain.motor, b.drivetrain.motor) &&
         encoders == b.encoders && same(floor, b.floor) && same(commanded_motion, b.commanded_motion) &&
         pushes.size() == b.pushes.size() && run.id == b.run.id;
}

bool acts(const Effect& effect, const std::vector<Rig>& rigs) {
  return std::any_of(rigs.begin(), rigs.end(), [&](const Rig& rig) {
    Rig changed = rig;
    effect.info->apply(effect.values, changed);
    return !same(changed, rig);
  });
}

// Those with which it would act, each alone at its typical value, or at the largest one met.
std::vector<std::string> would_act(const Effect& effect, const std::vector<Rig>& rigs) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < effect.values.numbers.size(); ++i) {
    const EffectParameter& p = effect.info->parameters[i];
    Effect set = effect;
    set.values.numbers[i] = p.typical != p.neutral ? p.typical : p.plausible_max;
    if (acts(set, rigs)) names.push_back("effects." + effect.info->name + "." + p.name);
  }
  return names;
}

std::string sentence(const Effect& effect, const std::vector<Rig>& rigs) {
  const std::string start = fmt::format("effects.{} changes nothing", effect.info->name);
  const std::vector<std::string> names = would_act(effect, rigs);
  if (!names.empty()) return fmt::format("{} as it is given: set {}", start, fmt::join(names, " or "));
  if (!effect.values.run.empty()) return fmt::format("{}: no run is called '{}'", start, effect.values.run);
  return start + " of this robot, whatever its parameters";
}

}  // namespace

std::vector<std::string> silent_effects(const std::vector<Effect>& effects, const std::vector<Rig>& rigs) {
  std::vector<std::string> sentences;
  for (const Effect& effect : effects) {
    if (!acts(effect, rigs)) sentences.push_back(sentence(effect, rigs));
  }
  return sentences;
}

}  // namespace umbsim
