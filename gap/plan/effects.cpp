#include "gap/plan/effects.h"

#include <algorithm>
#include <cmath>

#include "gap/search/drivable.h"

namespace umbsim::gap {
namespace {

constexpr double kWeakestShare = 1.0 / 300;  // of the plausible maximum: acts less than any noise

const EffectParameter* parameter_of(const Hypothesis& hypothesis) {
  for (const EffectParameter& p : find_effect(hypothesis.effect).parameters) {
    if (p.name == hypothesis.parameters.front().name) return &p;
  }
  return nullptr;
}

// What acts the more the smaller it is.
bool acts_when_small(const std::string& parameter) {
  return parameter == "friction" || parameter == "ticks_per_revolution";
}

PlannedHypothesis planned(Hypothesis hypothesis) {
  PlannedHypothesis p;
  p.by_run_number = is(hypothesis.effect, kByRun);
  // Softness of the tyres goes with a toe, it is not what is asked about.
  p.happens = !hypothesis.with;
  if (const EffectParameter* strength = parameter_of(hypothesis)) {
    if (acts_when_small(strength->name)) {
      p.weak = 0.8;
      p.strong = std::max(strength->plausible_min, 0.01);
    } else {
      p.strong = strength->plausible_max;
      p.weak = p.strong * kWeakestShare;
    }
  }
  p.hypothesis = std::move(hypothesis);
  return p;
}

// A moment of the first run: on a leg (the last one if there are fewer), at a share of its time.
struct OnLeg {
  int leg = 1;
  double seconds_into_leg = 0;
  Pose2 X_WB;
};

OnLeg on_leg(const Model& model, int wanted_leg, double share) {
  OnLeg at;
  for (const Stretch& s : model.stretches(0)) {
    if (s.kind != Stretch::Kind::leg || s.leg > wanted_leg) continue;
    at.leg = s.leg;
    at.seconds_into_leg = share * (s.end_s - s.start_s);
    const auto& truth = model.recording().runs[0].truth;
    std::size_t k = 0;
    while (k + 1 < truth.size() && truth[k].time_s < s.start_s + at.seconds_into_leg) ++k;
    at.X_WB = model.nominal().tracks[0][k];
  }
  return at;
}

}  // namespace

std::vector<PlannedHypothesis> planned_hypotheses(const Model& model, const std::set<std::string>& wanted) {
  const Recording& recording = model.recording();
  std::vector<PlannedHypothesis> all;
  std::vector<Hypothesis> plain = plain_hypotheses(1 / recording.encoder_rate_hz, recording.robot.ticks_per_revolution,
                                                   model.wheel_width_m(), model.motor_inertia_kgm2(), model.mass_kg());
  std::erase_if(plain, [&](const Hypothesis& f) { return wanted.count(f.effect) == 0; });
  for (Hypothesis& f : drivable(model, std::move(plain))) all.push_back(planned(std::move(f)));
  const Pose2 right_wheel{0, -recording.robot.wheelbase_m / 2, 0};
  const Pose2 cable = on_leg(model, 1, 0.5).X_WB * right_wheel;
  // Grip is needed where wheels speed up, stop and turn, not in between.
  const Pose2 corner = on_leg(model, 1, 1).X_WB * right_wheel;
  for (Hypothesis f : {bump_hypothesis(cable.x_m, cable.y_m, cable.theta_rad), lift_hypothesis(corner.x_m, corner.y_m),
                       patch_hypothesis(corner.x_m, corner.y_m)}) {
    all.push_back(planned(std::move(f)));
  }
  const OnLeg push = on_leg(model, 2, 0.5);
  all.push_back(planned(push_hypothesis(recording.runs[0].id, push.leg, push.seconds_into_leg, model.mass_kg())));
  all.back().in_first_run = true;
  std::erase_if(all, [&](const PlannedHypothesis& p) { return wanted.count(p.hypothesis.effect) == 0; });
  return all;
}

std::vector<std::string> without_hypothesis(const std::set<std::string>& wanted) {
  std::set<std::string> missing = wanted;
  for (const Hypothesis& f : plain_hypotheses(0.02, 2000)) missing.erase(f.effect);
  std::erase_if(missing, [](const std::string& effect) { return is(effect, kOfAPlace); });
  return {missing.begin(), missing.end()};
}

bool plausible(const Effect& effect) {
  for (std::size_t i = 0; i < effect.info->parameters.size(); ++i) {
    const EffectParameter& p = effect.info->parameters[i];
    const double value = effect.values.numbers[i];
    if (value == p.neutral) continue;
    if (p.plausible_max > 0 && std::abs(value) > p.plausible_max) return false;
    if (acts_when_small(p.name) && value < p.plausible_min) return false;
  }
  return true;
}

}  // namespace umbsim::gap
