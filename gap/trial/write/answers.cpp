#include "gap/trial/write/answers.h"

#include <algorithm>
#include <cmath>

#include "core/text/yaml_reader.h"

namespace umbsim {

Json effect_json(const Effect& effect) {
  Json json = Json::object();
  for (std::size_t i = 0; i < effect.info->parameters.size(); ++i) {
    const EffectParameter& p = effect.info->parameters[i];
    if (effect.values.numbers[i] != p.neutral) json[p.name] = effect.values.numbers[i];
  }
  if (!effect.values.run.empty()) json["run"] = effect.values.run;
  return json;
}

namespace {

TrueEffect read_effect(const YamlValue& value) {
  YamlMap map(value);
  TrueEffect effect;
  for (const auto& [key, parameter] : map.entries()) {
    if (key == "run")
      effect.run = parameter.string();
    else
      effect.parameters[key] = parameter.number();
  }
  return effect;
}

bool in_catalogue(const std::string& effect) {
  const std::vector<EffectInfo>& all = catalogue();
  return std::any_of(all.begin(), all.end(), [&](const EffectInfo& info) { return info.name == effect; });
}

Tier tier_of(const Answer& answer) {
  if (answer.effects.empty()) return Tier::no_effect;
  for (const auto& [effect, values] : answer.effects) {
    const bool excluded = std::find(answer.excluded.begin(), answer.excluded.end(), effect) != answer.excluded.end();
    if (excluded || !in_catalogue(effect)) return Tier::outside;
  }
  return answer.effects.size() == 1 ? Tier::single : Tier::pairs;
}

void read_severities(const YamlValue& value, Answer& answer) {
  YamlMap map(value);
  for (const auto& [effect, entry] : map.entries()) {
    const auto found = answer.effects.find(effect);
    if (found == answer.effects.end()) entry.fail("is not among the effects of the case");
    YamlMap severity(entry);
    found->second.severity = severity.at("severity").number(Bounds::at_least(0));
    severity.find("drawn");
    severity.find("signal");
    severity.finish();
  }
}

Answer read_answer(const YamlValue& value) {
  YamlMap map(value);
  Answer answer;
  YamlMap effects(map.at("effects"));
  for (const auto& [name, values] : effects.entries()) answer.effects[name] = read_effect(values);
  if (const auto list = map.find("excluded")) {
    for (const YamlValue& item : list->list()) answer.excluded.push_back(item.string());
  }
  if (const auto severities = map.find("severities")) read_severities(*severities, answer);
  answer.undetectable_expected = map.boolean("undetectable_expected", false);
  answer.tier = tier_of(answer);
  if (const auto tier = map.find("tier")) {
    std::vector<std::string> names;
    for (const Tier t : kTiers) names.push_back(name(t));
    const std::string chosen = tier->choice(names);
    for (const Tier t : kTiers) {
      if (chosen == name(t)) answer.tier = t;
    }
  }
  for (const char* note : {"platform", "noise_level", "seed", "world"}) map.find(note);
  map.finish();
  return answer;
}

}  // namespace

std::optional<double> Answer::severity() const {
  std::optional<double> largest;
  for (const auto& [effect, values] : effects) {
    if (!values.severity) return std::nullopt;
    largest = std::max(largest.value_or(0), *values.severity);
  }
  return largest;
}

Json answer_json(const TrialCase& drawn, const std::vector<ScaledEffect>& effects) {
  Json json{{"tier", name(drawn.tier)},
            {"effects", Json::object()},
            {"excluded", drawn.excluded},
            {"severities", Json::object()}};
  bool undetectable = !effects.empty();
  for (const ScaledEffect& e : effects) {
    const std::string& effect = e.effect.info->name;
    json["effects"][effect] = effect_json(e.effect);
    json["severities"][effect] = {{"drawn", e.drawn}, {"severity", e.severity}, {"signal", name(e.signal)}};
    undetectable = undetectable && e.undetectable;
  }
  json["undetectable_expected"] = undetectable;
  json["platform"] = drawn.platform;
  json["noise_level"] = drawn.noise_level;
  json["seed"] = drawn.seed;
  return json;
}

Answers read_answers(const std::filesystem::path& file) {
  const YamlValue document = YamlValue::load(file.string());
  YamlMap map(document);
  map.at("format").choice({"umbsim-trial-answers/1"});
  for (const char* note : {"trial", "seed"}) map.find(note);
  Answers answers;
  YamlMap cases(map.at("cases"));
  for (const auto& [name, value] : cases.entries()) answers[name] = read_answer(value);
  map.finish();
  return answers;
}

}  // namespace umbsim
