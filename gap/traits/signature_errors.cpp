#include "gap/traits/signature_errors.h"

#include <map>

#include "gap/traits/traits.h"

namespace umbsim::gap {

// What parts of the course err by was measured on MuJoCo's recordings of single effects
// (bench/worlds/lists/mujoco_67.yaml), for the effects that show there; the rest, motions and counts are set by hand.
// docs/gap-method.md, "Beside what is there already".
SignatureErrors signature_errors_of(const std::string& effect) {
  static const SignatureErrors rolling{{0.01, 0.01, 0.01, 0.01}, 0.01, 0.1};
  // clang-format off
  //                              speeding leg  in place arc  motion counts
  static const std::map<std::string, SignatureErrors> table{
      {"wheel_misalignment",    {{0.3,  0.3,  0.6,  1.5},  0.3,  0.1}},
      {"wheel_eccentricity",    {{0.06, 0.03, 0.1,  0.05}, 0.1,  0.1}},
      {"load_shift",            {{0.1,  0.1,  0.1,  0.1},  0.03, 0.1}},
      {"backlash",              {{0.8,  0.5,  1.0,  1.0},  0.5,  0.5}},
      {"motor_response",        {{0.1,  0.1,  0.1,  0.1},  0.1,  0.1}},
      {"over_acceleration",     {{0.03, 0.0,  0.0,  0.0},  0.03, 0.2}},
      {"fast_turning",          {{0.03, 0.0,  0.03, 0.03}, 0.0,  0.2}},
      {"encoder_resolution",    {{0.1,  0.06, 0.17, 0.1},  0.3,  0.3}},
      {"encoder_sampling",      {{0.6,  0.6,  1.0,  1.0},  1.0,  0.3}},
      {"encoder_missed_counts", {{0.1,  0.1,  0.1,  0.1},  0.03, 0.02}},
      {"encoder_latency",       {{0.06, 0.06, 0.06, 0.06}, 0.03, 0.1}},
      {"tyre_compliance",       {{0.06, 0.02, 0.05, 0.05}, 0.03, 0.1}},
      {"contact_patch",         {{1.0,  1.0,  1.0,  1.0},  0.3,  0.1}},
      {"tyre_creep",            {{0.2,  0.2,  0.2,  0.2},  0.2,  0.1}},
      {"caster_swivel",         {{0.2,  0.2,  0.2,  0.2},  0.3,  0.1}},
      {"caster_drag",           {{1.0,  1.0,  1.0,  1.0},  0.3,  0.1}},
      {"slippery_floor",        {{1.0,  1.0,  1.0,  1.0},  0.5,  0.1}},
      {"slippery_patch",        {{0.3,  0.3,  0.2,  0.4},  0.3,  0.1}},
      {"bump",                  {{0.25, 0.25, 0.1,  0.1},  0.3,  0.1}},
      {"push",                  {{0.1,  0.1,  0.1,  0.1},  0.2,  0.1}},
      {"wheel_lift",            {{0.05, 0.05, 0.2,  0.1},  0.3,  0.1}},
      {"floor_slope",           {{0.1,  0.1,  0.1,  0.1},  0.03, 0.1}},
  };
  // clang-format on
  const auto found = table.find(effect);
  SignatureErrors errors = found == table.end() ? rolling : found->second;
  errors.beside = is_kinematic(effect) ? 0 : 1;
  return errors;
}

}  // namespace umbsim::gap
