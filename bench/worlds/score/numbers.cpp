#include "bench/worlds/score/numbers.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "gap/traits/number_errors.h"
#include "gap/trial/draw/effect_draws.h"

namespace umbsim::worlds {
namespace {

constexpr double kWithin = 3;  // a factor: standard deviation of its logarithm
constexpr double kHalf95 = 1.96;
constexpr double kLeastShare = 0.001;                  // of a size, for logarithms
constexpr double kGrid = 1.1;                          // from one error that is tried to the next
constexpr double kFinest = 0.02, kCoarsest = 30;       // of the usual one
constexpr double kUsual[] = {0.1, 0.005, 0.02, 0.02};  // by Measure

std::optional<Measure> measure_of(const EffectInfo& info, const EffectParameter& p) {
  const std::vector<std::string> strengths = strength_parameters(info.name);
  if (std::count(strengths.begin(), strengths.end(), p.name)) return p.unit == "s" ? Measure::time : Measure::size;
  if (info.name == "bump") return std::nullopt;
  if (p.name == "x_m" || p.name == "y_m") return Measure::place;
  if (p.unit == "rad") return Measure::angle;
  return std::nullopt;
}

// Found less true; and half of an interval about what was found, as a standard deviation.
struct Off {
  double off = 0, sd = 0;
};

std::optional<Off> off_by_logarithm(const ParameterEstimate& e, double truth, double neutral) {
  const double found = e.value - neutral, ratio = found / (truth - neutral);
  if (!(ratio > 0) || !std::isfinite(ratio)) return std::nullopt;
  const auto share = [&](double bound) { return std::max(kLeastShare, (bound - neutral) / found); };
  return Off{std::log(ratio), std::abs(std::log(share(e.high) / share(e.low))) / (2 * kHalf95)};
}

std::optional<Off> off_by(Measure measure, const ParameterEstimate& e, double truth, double neutral) {
  if (measure == Measure::size) return off_by_logarithm(e, truth, neutral);
  if (measure == Measure::time && !(e.value > neutral)) return std::nullopt;
  const double off = e.value - truth;
  return Off{measure == Measure::angle ? std::remainder(off, 2 * M_PI) : off, (e.high - e.low) / (2 * kHalf95)};
}

void add_numbers(const std::string& effect, const WorldVerdict& w, std::vector<FoundNumber>& numbers) {
  const auto& causes = w.verdict.diagnosis.causes;
  const auto found = causes.front().parameters.find(effect);
  if (found == causes.front().parameters.end()) return;
  const EffectInfo& info = find_effect(effect);
  for (const EffectParameter& p : info.parameters) {
    const std::optional<Measure> measure = measure_of(info, p);
    const auto& truths = w.verdict.answer.effects.at(effect).parameters;
    if (!measure || !truths.count(p.name) || !found->second.count(p.name)) continue;
    const std::optional<Off> off = off_by(*measure, found->second.at(p.name), truths.at(p.name), p.neutral);
    if (!off) continue;
    const double stated = error_in_use(effect, *measure);
    numbers.push_back({effect, w.groups.at("engine"), *measure, off->off,
                       std::sqrt(std::max(0.0, off->sd * off->sd - stated * stated))});
  }
}

}  // namespace

std::vector<FoundNumber> found_numbers(const WorldScore& score) {
  std::vector<FoundNumber> numbers;
  for (const WorldVerdict& w : score.verdicts) {
    if (w.kind != "single" || !w.visible() || w.verdict.failed || w.verdict.diagnosis.causes.empty()) continue;
    add_numbers(w.verdict.answer.effects.begin()->first, w, numbers);
  }
  return numbers;
}

double error_in_use(const std::string& effect, Measure measure) {
  const gap::NumberError error = gap::number_error_of(effect);
  if (measure == Measure::size) return error.log;
  if (measure == Measure::time) return error.time_s;
  return measure == Measure::place ? gap::kPlaceElsewhere_m : gap::kAngleElsewhere_rad;
}

double likeliest_error(const std::vector<FoundNumber>& numbers, Measure measure) {
  const double usual = kUsual[int(measure)];
  double best = usual, most = -1e300;
  for (double error = kFinest * usual; error < kCoarsest * usual; error *= kGrid) {
    double density = -std::pow(std::log(error / usual) / std::log(kWithin), 2) / 2;
    for (const FoundNumber& n : numbers) {
      const double variance = n.noise_sd * n.noise_sd + error * error;
      density -= (n.off * n.off / variance + std::log(variance)) / 2;
    }
    if (density <= most) continue;
    most = density;
    best = error;
  }
  return best;
}

int held(const std::vector<FoundNumber>& numbers, double error) {
  return int(std::count_if(numbers.begin(), numbers.end(), [&](const FoundNumber& n) {
    return std::abs(n.off) <= kHalf95 * std::hypot(n.noise_sd, error);
  }));
}

}  // namespace umbsim::worlds
