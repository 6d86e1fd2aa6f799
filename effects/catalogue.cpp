#include "effects/catalogue.h"

#include <algorithm>
#include <memory>

#include "effects/geometry.h"

namespace umbsim {
namespace {

// A parameter that is a member of an effect's struct. Its default there is the neutral value.
template <class E>
struct Member {
  const char* name;
  const char* unit;
  double E::*member;
  Bounds bounds;
  double plausible_min;
  double plausible_max;
};

template <class E>
EffectInfo line(const char* name, Stage stage, const char* lecture, std::vector<Member<E>> members, const char* source,
                const char* description) {
  EffectInfo info{name, stage, lecture, {}, source, description, {}};
  for (const Member<E>& m : members) {
    info.parameters.push_back({m.name, m.unit, E{}.*m.member, m.bounds, m.plausible_min, m.plausible_max});
  }
  info.apply = [members](const std::vector<double>& values, Rig& rig) {
    E effect;
    for (std::size_t i = 0; i < members.size(); ++i) effect.*members[i].member = values[i];
    umbsim::apply(effect, rig);
  };
  return info;
}

const Bounds kRatio = Bounds::between(-0.5, 0.5);

}  // namespace

const char* name(Stage stage) {
  constexpr const char* kNames[] = {"geometry", "drivetrain", "encoder", "contact", "floor", "measurement"};
  return kNames[int(stage)];
}

const std::vector<EffectInfo>& catalogue() {
  using G = Stage;
  static const std::vector<EffectInfo> table = {
      line<WheelRadiusScale>("wheel_radius_scale", G::geometry, "systematic: mean of the wheel radii off nominal",
                             {{"relative", "1", &WheelRadiusScale::relative, kRatio, 0.001, 0.03}},
                             "Velagic lecture 7.3; Borenstein & Feng 1996",
                             "Both wheel radii are (1 + relative) times nominal: every leg is too long or too short."),
      line<WheelRadiusDifference>(
          "wheel_radius_difference", G::geometry, "systematic: unequal wheel radii",
          {{"relative", "1", &WheelRadiusDifference::relative, kRatio, 0.0005, 0.01}},
          "Velagic lecture 7.3; Borenstein & Feng 1996 (E_d, type B error)",
          "Right over left radius is 1 + relative, the mean stays: legs curve in the same sense cw and ccw."),
      line<Wheelbase>("wheelbase", G::geometry, "systematic: wheelbase off nominal",
                      {{"relative", "1", &Wheelbase::relative, kRatio, 0.002, 0.05}},
                      "Velagic lecture 7.3; Borenstein & Feng 1996 (E_b, type A error)",
                      "The wheels stand (1 + relative) times the nominal wheelbase apart: every turn is off in "
                      "proportion to its angle."),
  };
  return table;
}

const EffectInfo& find_effect(const std::string& name) {
  std::vector<std::string> names;
  for (const EffectInfo& info : catalogue()) {
    if (info.name == name) return info;
    names.push_back(info.name);
  }
  throw InputError("unknown effect '" + name + "'; " + list_choices(name, names));
}

std::vector<Effect> read_effects(const YamlValue& value) {
  std::vector<Effect> effects;
  YamlMap map(value);
  for (const EffectInfo& info : catalogue()) {
    const auto entry = map.find(info.name);
    if (!entry) continue;
    YamlMap parameters(*entry);
    Effect effect{&info, {}};
    for (const EffectParameter& p : info.parameters) {
      effect.values.push_back(parameters.number(p.name, p.neutral, p.bounds));
    }
    parameters.finish();
    effects.push_back(std::move(effect));
  }
  map.finish();
  return effects;
}

Rig apply_effects(const std::vector<Effect>& effects, Rig rig) {
  for (const EffectInfo& info : catalogue()) {
    for (const Effect& effect : effects) {
      if (effect.info == &info) info.apply(effect.values, rig);
    }
  }
  return rig;
}

}  // namespace umbsim
