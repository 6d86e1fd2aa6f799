#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace umbsim {

/// Names of effects that act together. "none" and "unknown" stand alone.
using EffectNames = std::set<std::string>;

/// "bump+push"
std::string joined(const EffectNames& names);
EffectNames split(const std::string& joined);

struct ParameterEstimate {
  double value = 0;
  double low = 0;   ///< of the 95 % interval; infinite where the data say nothing
  double high = 0;
};

struct Cause {
  EffectNames effects;
  std::map<std::string, std::map<std::string, ParameterEstimate>> parameters;  ///< by effect and parameter
  double probability = 0;
  std::optional<double> squared_error_drop;  ///< of this cause alone against none
};

/// One segment of a run in which the gap shows.
struct GapSegment {
  std::string run;
  int leg = 0;
};

/// What a diagnosis.json says (docs/outputs.md), as far as it is scored.
struct Diagnosis {
  bool detected = false;
  std::string stage;
  std::string pattern;
  std::vector<GapSegment> segments;  ///< ranked
  std::optional<std::pair<double, double>> place_m;
  std::vector<Cause> causes;         ///< ranked
  std::vector<EffectNames> set;
  std::vector<EffectNames> indistinguishable;  ///< groups
  std::optional<double> closure;     ///< held-out fraction
};

/// Throws InputError if it is not a diagnosis. Keys that are not scored are not looked at.
Diagnosis read_diagnosis(const std::filesystem::path& file);

}  // namespace umbsim
