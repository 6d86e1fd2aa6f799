#include "gap/noise/counts_noise.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace umbsim::gap {
namespace {

// What was asked for in turns is in the commands, on a leg their corrections are, too. Between rare samples counters
// stand still, which no other effect makes them do.
constexpr CommandFeatures kFeaturesSd{0.1, 0.05, 0.02, 0.015, 0.05};
constexpr double kUsualRuns = 8;

}  // namespace

CommandFeatures command_features_sd(const Recording& recording, const std::vector<CommandResponse>& measured,
                                    const std::vector<CommandResponse>& foretold) {
  double lag_s = 0;
  double runs = 0;
  for (std::size_t r = 0; r < measured.size(); ++r) {
    if (!measured[r].known || !foretold[r].known) continue;
    lag_s += measured[r].lag_s - foretold[r].lag_s;
    runs += 1;
  }
  CommandFeatures sd = kFeaturesSd;
  const RecordedPath& p = recording.path;
  if (runs == 0 || lag_s < 0) return sd;
  const auto widen = [&](double& s, const std::optional<double>& speed, const std::optional<double>& acceleration) {
    if (speed && acceleration) s = std::hypot(s, lag_s / runs * *acceleration / *speed);  // in ramps' durations
  };
  widen(sd[0], p.linear_speed_mps, p.linear_acceleration_mps2);
  widen(sd[1], p.angular_speed_radps, p.angular_acceleration_radps2);
  return sd;
}

double gain_scatter(const RunGroups& groups, const std::vector<CommandResponse>& measured,
                    const std::vector<CommandResponse>& foretold, double usual) {
  double square = kUsualRuns * usual * usual;
  double freedom = kUsualRuns;
  for (std::size_t g = 0; g < groups.rolling.size(); ++g) {
    for (double CommandResponse::*gain : {&CommandResponse::left_gain, &CommandResponse::right_gain}) {
      double runs = 0;
      double sum = 0;
      double squares = 0;
      for (std::size_t r = 0; r < measured.size(); ++r) {
        if (groups.group_of[r] != g || !measured[r].known || !foretold[r].known) continue;
        const double off = measured[r].*gain - foretold[r].*gain;
        runs += 1;
        sum += off;
        squares += off * off;
      }
      if (runs < 2) continue;
      square += std::max(0.0, squares - sum * sum / runs);
      freedom += runs - 1;
    }
  }
  return std::max(usual, std::sqrt(square / freedom));
}

}  // namespace umbsim::gap
