#include "gap/trial/score/verdict.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "gap/trial/draw/effect_draws.h"

namespace umbsim {
namespace {

// A place counts as found within this of the effect's edge.
constexpr double kPlaceTolerance_m = 0.1;

// Where an effect shows by its nature; effects that are not listed have no pattern of their own.
const std::map<std::string, std::set<std::string>> kPatterns = {
    {"wheel_radius_scale", {"legs"}},       {"wheel_radius_difference", {"legs"}},
    {"wheelbase", {"turns"}},               {"wheel_misalignment", {"legs"}},
    {"wheel_eccentricity", {"wheel_angle"}}, {"backlash", {"turns", "leg_start"}},
    {"fast_turning", {"turns"}},            {"contact_patch", {"turns"}},
    {"caster_swivel", {"leg_start"}},       {"floor_slope", {"world_direction"}},
    {"carpet_drift", {"world_direction"}},
};

const EffectInfo* info_of(const std::string& effect) {
  for (const EffectInfo& info : catalogue()) {
    if (info.name == effect) return &info;
  }
  return nullptr;
}

bool tied(const Diagnosis& d, const std::string& a, const std::string& b) {
  if (a == b) return true;
  return std::any_of(d.indistinguishable.begin(), d.indistinguishable.end(),
                     [&](const EffectNames& group) { return group.count(a) && group.count(b); });
}

// Every effect of the truth can be paired off with one of the named that is it or tied with it.
bool tied(const Diagnosis& d, const EffectNames& truth, EffectNames named) {
  if (truth.size() != named.size()) return false;
  for (const std::string& effect : truth) {
    const auto partner = named.count(effect)
                             ? named.find(effect)
                             : std::find_if(named.begin(), named.end(),
                                            [&](const std::string& other) { return tied(d, effect, other); });
    if (partner == named.end()) return false;
    named.erase(partner);
  }
  return true;
}

double parameter(const TrueEffect& effect, const char* name) {
  const auto found = effect.parameters.find(name);
  return found == effect.parameters.end() ? 0 : found->second;
}

// Half the size of the spot that an effect of a place covers.
double extent_m(const std::string& name, const TrueEffect& effect) {
  if (name == "slippery_patch") return parameter(effect, "radius_m");
  return name == "wheel_lift" ? parameter(effect, "length_m") / 2 : 0;
}

std::optional<bool> location_right(const std::string& name, const TrueEffect& effect, const Diagnosis& d) {
  if (effect.parameters.count("x_m") && effect.parameters.count("y_m")) {
    if (!d.place_m) return false;
    const double distance =
        std::hypot(d.place_m->first - parameter(effect, "x_m"), d.place_m->second - parameter(effect, "y_m"));
    return distance <= kPlaceTolerance_m + extent_m(name, effect);
  }
  if (!effect.run.empty()) {
    if (d.segments.empty()) return false;
    // A leg that is not written is the neutral one, the first.
    const int leg = effect.parameters.count("leg") ? int(parameter(effect, "leg")) : 1;
    return d.segments.front().run == effect.run && d.segments.front().leg == leg;
  }
  const auto patterns = kPatterns.find(name);
  if (patterns == kPatterns.end()) return std::nullopt;
  return patterns->second.count(d.pattern) > 0;
}

void judge_parameters(const std::string& name, const TrueEffect& truth, const Cause& cause, Verdict& v) {
  const EffectInfo* info = info_of(name);
  const auto found = cause.parameters.find(name);
  for (const std::string& strength : strength_parameters(name)) {
    const auto value = truth.parameters.find(strength);
    if (value == truth.parameters.end()) continue;
    const auto p = std::find_if(info->parameters.begin(), info->parameters.end(),
                                [&](const EffectParameter& each) { return each.name == strength; });
    // What is not reported is taken as neutral, and known exactly.
    ParameterEstimate estimate{p->neutral, p->neutral, p->neutral};
    if (found != cause.parameters.end() && found->second.count(strength)) estimate = found->second.at(strength);
    const double t = value->second;
    v.parameters.push_back({name, strength, t, estimate.value, std::abs(estimate.value - t) / std::abs(t - p->neutral),
                            estimate.low <= t && t <= estimate.high});
  }
}

void judge_single(Verdict& v) {
  const auto& [name, effect] = *v.answer.effects.begin();
  const EffectInfo* info = info_of(name);
  if (!info) return;
  v.stage_right = !v.failed && v.diagnosis.stage == umbsim::name(info->stage);
  v.location_right = v.failed ? location_right(name, effect, {}) : location_right(name, effect, v.diagnosis);
}

void judge_causes(const EffectNames& truth, Verdict& v) {
  const Diagnosis& d = v.diagnosis;
  const Cause& first = d.causes.front();
  v.named = joined(first.effects);
  v.probability = first.probability;
  v.detected = v.named != "none";
  v.unknown = v.named == "unknown";
  const EffectNames wanted = v.answer.tier == Tier::outside ? EffectNames{"unknown"} : truth;
  v.right = first.effects == wanted;
  v.right_or_tied = v.right || tied(d, truth, first.effects);
  for (EffectNames group : d.indistinguishable) {
    // What the diagnosis had to do without is no rival.
    for (const std::string& effect : v.answer.excluded) {
      if (truth.count(effect) == 0) group.erase(effect);
    }
    for (const std::string& effect : truth) v.distinguishable &= !(group.count(effect) && group.size() > 1);
  }
  for (const EffectNames& member : d.set) {
    v.in_set |= member == wanted;
    v.both_in_set |= std::includes(member.begin(), member.end(), truth.begin(), truth.end());
    for (const std::string& effect : truth) v.one_in_set |= member.count(effect) > 0;
  }
  if (v.right && v.answer.tier != Tier::outside) {
    for (const auto& [name, effect] : v.answer.effects) judge_parameters(name, effect, first, v);
  }
}

}  // namespace

Verdict judge(const std::string& name, const Answer& answer, const std::optional<Diagnosis>& diagnosis,
              double wall_s) {
  Verdict v;
  v.name = name;
  v.answer = answer;
  v.wall_s = wall_s;
  v.failed = !diagnosis;
  v.named = "failed";
  EffectNames truth;
  for (const auto& [effect, values] : answer.effects) truth.insert(effect);
  if (truth.empty()) truth = {"none"};
  v.truth = joined(truth);
  if (diagnosis) {
    v.diagnosis = *diagnosis;
    judge_causes(truth, v);
  } else {
    v.detected = answer.effects.empty();  // a failure counts against the diagnosis in every tier
  }
  if (answer.effects.size() == 1 && answer.tier != Tier::outside) judge_single(v);
  return v;
}

}  // namespace umbsim
