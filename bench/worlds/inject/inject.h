#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "gap/trial/write/trial_folder.h"
#include "recording/recording.h"

namespace umbsim::worlds {

/// A fault of known size put into a real recording: real noise, real tyres, a known answer.
struct Injection {
  std::string name;    ///< of the line in injections()
  std::string effect;  ///< of the catalogue, that does the same to a robot
  Json parameters;     ///< its parameters
};

/// How a real recording can be spoiled.
struct InjectionKind {
  std::string name;
  std::string effect;
  std::string text;  ///< one line
  double min = 0;    ///< of the size, drawn log-uniformly
  double max = 0;
};
const std::vector<InjectionKind>& injections();

/// The recording as it would be of a robot with a fault of this size; sign and wheel are drawn. Throws InputError where
/// the recording cannot carry it (wear needs several runs, late counts a sample as short as the delay).
Recording spoiled(const Recording& real, const InjectionKind& kind, double size, std::uint64_t seed, Injection& done);

/// In noise floors, as in a trial: the change of the pose that the counts lead to, against what the runs of a direction
/// differ by; nothing where there are no two runs alike.
std::optional<double> severity_of(const Recording& real, const Recording& spoiled);

struct InjectResult {
  std::size_t recordings = 0;
  std::size_t unspoiled = 0;
  std::size_t refused = 0;
  std::string seal;
};

/// Writes `folder` as a trial's folder with `each` spoiled copies of every recording, and FOLDER/unspoiled with the
/// recordings as they are, whose answers nobody knows. Throws InputError if the folder holds anything.
InjectResult inject(const std::vector<std::string>& recordings, const TrialFolder& folder, int each,
                    std::uint64_t seed);

}  // namespace umbsim::worlds
