#include "gap/trial/diagnose/diagnosis_file.h"

#include <fmt/format.h>

#include <limits>

#include "core/error.h"
#include "gap/trial/write/trial_folder.h"

namespace umbsim {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// JSON has no infinity: null stands for it.
double number_or(const Json& json, double fallback) { return json.is_null() ? fallback : json.get<double>(); }

ParameterEstimate read_parameter(const Json& json) {
  if (json.is_number()) return {json.get<double>(), -kInfinity, kInfinity};
  ParameterEstimate estimate{number_or(json.at("value"), 0), -kInfinity, kInfinity};
  if (json.contains("ci95") && !json["ci95"].is_null()) {
    estimate.low = number_or(json["ci95"].at(0), -kInfinity);
    estimate.high = number_or(json["ci95"].at(1), kInfinity);
  }
  return estimate;
}

Cause read_cause(const Json& json) {
  Cause cause;
  for (const auto& [effect, parameters] : json.at("effects").items()) {
    cause.effects.insert(effect);
    for (const auto& [name, value] : parameters.items()) {
      if (value.is_number() || value.is_object()) cause.parameters[effect][name] = read_parameter(value);
    }
  }
  cause.probability = number_or(json.at("probability"), 0);
  if (json.contains("squared_error_drop") && json["squared_error_drop"].is_number()) {
    cause.squared_error_drop = json["squared_error_drop"].get<double>();
  }
  return cause;
}

std::optional<double> optional_number(const Json& json, const char* key) {
  if (!json.contains(key) || !json[key].is_number()) return std::nullopt;
  return json[key].get<double>();
}

void read_where(const Json& where, Diagnosis& d) {
  d.stage = where.value("stage", "");
  d.pattern = where.value("pattern", "");
  if (where.contains("segments")) {
    for (const Json& s : where["segments"]) d.segments.push_back({s.value("run", ""), s.value("leg", 0)});
  }
  const auto place = where.find("place_m");
  if (place != where.end() && place->is_array() && place->size() == 2 && (*place)[0].is_number()) {
    d.place_m = {(*place)[0].get<double>(), (*place)[1].get<double>()};
  }
}

}  // namespace

std::string joined(const EffectNames& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : "+") + name;
  return text;
}

EffectNames split(const std::string& text) {
  EffectNames names;
  for (std::size_t from = 0; from <= text.size();) {
    const std::size_t to = std::min(text.find('+', from), text.size());
    names.insert(text.substr(from, to - from));
    from = to + 1;
  }
  return names;
}

Diagnosis read_diagnosis(const std::filesystem::path& file) {
  const Json json = read_json(file);
  try {
    if (json.at("format") != "umbsim-diagnosis/1") throw InputError(file.string() + ": is not an umbsim-diagnosis/1");
    Diagnosis d;
    d.detected = json.at("gap").at("detected").get<bool>();
    if (json.contains("where") && json["where"].is_object()) read_where(json["where"], d);
    for (const Json& cause : json.at("causes")) d.causes.push_back(read_cause(cause));
    if (d.causes.empty()) throw InputError(file.string() + ": causes is empty; 'none' and 'unknown' are causes, too");
    for (const Json& member : json.at("set")) d.set.push_back(split(member.get<std::string>()));
    if (json.contains("indistinguishable")) {
      for (const Json& group : json["indistinguishable"]) {
        const auto names = group.get<std::vector<std::string>>();
        d.indistinguishable.emplace_back(names.begin(), names.end());
      }
    }
    if (json.contains("closure")) d.closure = optional_number(json["closure"], "held_out_fraction");
    return d;
  } catch (const nlohmann::json::exception& e) {
    throw InputError(fmt::format("{}: {}", file.string(), e.what()));
  }
}

}  // namespace umbsim
