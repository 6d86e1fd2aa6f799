#include <algorithm>
#include <array>

#include "exchange/import/log.h"

namespace umbsim::exchange {
namespace {

struct UnitWords {
  WheelUnit unit;
  const char* name;
  bool rate;
  bool length;
};

constexpr std::array<UnitWords, 12> kUnits = {{{WheelUnit::ticks, "ticks", false, false},
                                               {WheelUnit::rad, "rad", false, false},
                                               {WheelUnit::deg, "deg", false, false},
                                               {WheelUnit::rev, "rev", false, false},
                                               {WheelUnit::m, "m", false, true},
                                               {WheelUnit::mm, "mm", false, true},
                                               {WheelUnit::cm, "cm", false, true},
                                               {WheelUnit::radps, "rad/s", true, false},
                                               {WheelUnit::degps, "deg/s", true, false},
                                               {WheelUnit::rpm, "rpm", true, false},
                                               {WheelUnit::mps, "m/s", true, true},
                                               {WheelUnit::mmps, "mm/s", true, true}}};

const UnitWords& words_of(WheelUnit unit) {
  return *std::find_if(kUnits.begin(), kUnits.end(), [&](const UnitWords& w) { return w.unit == unit; });
}

}  // namespace

const char* name(WheelUnit unit) { return words_of(unit).name; }
bool is_rate(WheelUnit unit) { return words_of(unit).rate; }
bool is_length(WheelUnit unit) { return words_of(unit).length; }

std::optional<WheelUnit> wheel_unit(const std::string& name) {
  for (const UnitWords& w : kUnits) {
    if (name == w.name) return w.unit;
  }
  return std::nullopt;
}

const std::vector<std::string>& wheel_unit_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const UnitWords& w : kUnits) all.emplace_back(w.name);
    return all;
  }();
  return names;
}

}  // namespace umbsim::exchange
