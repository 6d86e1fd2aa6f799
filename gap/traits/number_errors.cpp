#include "gap/traits/number_errors.h"

#include <map>

namespace umbsim::gap {

// Learned by `umbsim_worlds numbers` in other engines' worlds (docs/worlds.md, "How far numbers are off"), rounded; a
// tenth where too few were found. What follows from rolling alone is left out: what contacts do to it is a nuisance.
NumberError number_error_of(const std::string& effect) {
  // clang-format off
  static const std::map<std::string, NumberError> table{
      {"wheel_misalignment",  {0.4, 0}},
      {"load_shift",          {0.1, 0}},
      {"backlash",            {0.7, 0}},
      {"motor_response",      {0.03, 0.004}},
      {"over_acceleration",   {0.35, 0}},
      {"fast_turning",        {0.08, 0}},
      {"encoder_latency",     {0, 0.013}},
      {"tyre_compliance",     {0.15, 0}},
      {"contact_patch",       {0.1, 0}},
      {"tyre_creep",          {0.1, 0}},
      {"caster_swivel",       {0.1, 0}},
      {"caster_drag",         {0.2, 0}},
      {"slippery_floor",      {0.2, 0}},
      {"slippery_patch",      {0.2, 0}},
      {"bump",                {0.4, 0}},
      {"uneven_floor",        {0.1, 0}},
      {"floor_slope",         {0.3, 0}},
      {"push",                {0.4, 0}},
      {"wheel_lift",          {0.2, 0}},
  };
  // clang-format on
  const auto found = table.find(effect);
  return found == table.end() ? NumberError{} : found->second;
}

}  // namespace umbsim::gap
