// What a fault of the robot does to its counts, or to what its experimenter writes in the header.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bench/worlds/inject/inject.h"
#include "core/error.h"
#include "core/random.h"

namespace umbsim::worlds {
namespace {

using Counts = std::int64_t EncoderSample::*;
constexpr Counts kWheels[] = {&EncoderSample::left_ticks, &EncoderSample::right_ticks};
constexpr const char* kSides[] = {"left", "right"};

// Counts times a factor, from the first on, so that a run begins where it began.
void scale_counts(RecordedRun& run, Counts wheel, double factor) {
  const std::int64_t first = run.encoders.front().*wheel;
  for (EncoderSample& e : run.encoders) e.*wheel = first + std::llround(double(e.*wheel - first) * factor);
}

// A right wheel that is larger than the left needs fewer counts for the same way.
void unequal_wheels(Recording& r, double delta) {
  for (RecordedRun& run : r.runs) {
    scale_counts(run, kWheels[0], (2 + delta) / 2);
    scale_counts(run, kWheels[1], (2 + delta) / (2 * (1 + delta)));
  }
}

void lose_counts(Recording& r, Counts wheel, double probability, std::uint64_t seed) {
  for (std::size_t i = 0; i < r.runs.size(); ++i) {
    RandomStream random(seed, "inject lost counts", i);
    std::int64_t lost = 0, before = r.runs[i].encoders.front().*wheel;
    for (EncoderSample& e : r.runs[i].encoders) {
      const std::int64_t passed = e.*wheel - before, step = passed < 0 ? -1 : 1;
      before = e.*wheel;
      for (std::int64_t k = std::abs(passed); k > 0; --k) lost += random.uniform() < probability ? step : 0;
      e.*wheel -= lost;
    }
  }
}

void delay_counts(Recording& r, double seconds) {
  for (RecordedRun& run : r.runs) {
    const std::vector<EncoderSample> was = run.encoders;
    for (EncoderSample& e : run.encoders) {
      const auto after = std::upper_bound(was.begin(), was.end(), e.time_s - seconds + 1e-9,
                                          [](double t, const EncoderSample& s) { return t < s.time_s; });
      const EncoderSample& then = after == was.begin() ? was.front() : *(after - 1);
      e.left_ticks = then.left_ticks;
      e.right_ticks = then.right_ticks;
    }
  }
}

void coarsen_counts(Recording& r, double steps) {
  for (RecordedRun& run : r.runs) {
    for (EncoderSample& e : run.encoders) {
      for (const Counts wheel : kWheels) e.*wheel = std::llround(std::round(double(e.*wheel) / steps) * steps);
    }
  }
}

// The counters are latched at every interval and say the same until the next.
void latch_counts(Recording& r, double interval_s) {
  for (RecordedRun& run : r.runs) {
    double next_s = run.encoders.front().time_s;
    EncoderSample latched = run.encoders.front();
    for (EncoderSample& e : run.encoders) {
      if (e.time_s + 1e-9 >= next_s) {
        latched = e;
        next_s += interval_s;
      }
      e.left_ticks = latched.left_ticks;
      e.right_ticks = latched.right_ticks;
    }
  }
}

void wear_wheel(Recording& r, Counts wheel, double per_run) {
  for (std::size_t i = 0; i < r.runs.size(); ++i) scale_counts(r.runs[i], wheel, 1 / (1 + per_run * double(i)));
}

void need(bool possible, const std::string& what) {
  if (!possible) throw InputError(what);
}

double sample_s(const Recording& r) { return 1 / r.encoder_rate_hz; }

}  // namespace

const std::vector<InjectionKind>& injections() {
  static const std::vector<InjectionKind> table = {
      {"believed_radius", "wheel_radius_scale", "another wheel radius in the header", 0.005, 0.03},
      {"believed_ratio", "wheel_radius_scale", "another number of counts a revolution in the header", 0.005, 0.03},
      {"believed_wheelbase", "wheelbase", "another wheelbase in the header", 0.01, 0.05},
      {"unequal_gain", "wheel_radius_difference", "counts of the wheels scaled against each other", 0.001, 0.01},
      {"lost_counts", "encoder_missed_counts", "counts of one wheel lost by chance", 0.001, 0.01},
      {"late_counts", "encoder_latency", "counts that come late", 0.05, 0.2},
      {"coarse_counts", "encoder_resolution", "counts in steps of several", 10, 60},
      {"rare_counts", "encoder_sampling", "counters latched now and then", 0.1, 0.2},
      {"wear", "wear", "a wheel whose radius changes from run to run", 0.0005, 0.005},
  };
  return table;
}

Recording spoiled(const Recording& real, const InjectionKind& kind, double size, std::uint64_t seed, Injection& done) {
  RandomStream random(seed, "inject " + kind.name);
  Recording r = real;
  const double sign = random.uniform() < 0.5 ? -1 : 1;
  const std::size_t side = random.uniform() < 0.5 ? 0 : 1;
  done = {kind.name, kind.effect, Json::object()};
  if (kind.name == "believed_radius") {
    r.robot.wheel_radius_m /= 1 + sign * size;
    done.parameters["relative"] = sign * size;
  } else if (kind.name == "believed_ratio") {
    r.robot.ticks_per_revolution *= 1 + sign * size;
    done.parameters["relative"] = sign * size;
  } else if (kind.name == "believed_wheelbase") {
    r.robot.wheelbase_m /= 1 + sign * size;
    done.parameters["relative"] = sign * size;
  } else if (kind.name == "unequal_gain") {
    unequal_wheels(r, sign * size);
    done.parameters["relative"] = sign * size;
  } else if (kind.name == "lost_counts") {
    lose_counts(r, kWheels[side], size, seed);
    done.parameters[fmt::format("{}_probability", kSides[side])] = size;
  } else if (kind.name == "late_counts") {
    const double late_s = std::max(1.0, std::round(size / sample_s(r))) * sample_s(r);
    need(late_s <= 0.5, "late counts need samples of at most 0.5 s");
    delay_counts(r, late_s);
    done.parameters["seconds"] = late_s;
  } else if (kind.name == "coarse_counts") {
    const double steps = std::round(size);
    coarsen_counts(r, steps);
    done.parameters["ticks_per_revolution"] = r.robot.ticks_per_revolution / steps;
  } else if (kind.name == "rare_counts") {
    const double interval_s = std::round(size / sample_s(r)) * sample_s(r);
    need(interval_s >= 2 * sample_s(r), "counts latched rarely need samples that come more often");
    latch_counts(r, interval_s);
    done.parameters["interval_s"] = interval_s;
  } else {
    need(r.runs.size() >= 4, "wear needs four runs");
    wear_wheel(r, kWheels[side], sign * size);
    done.parameters[fmt::format("{}_relative_per_run", kSides[side])] = sign * size;
  }
  return r;
}

}  // namespace umbsim::worlds
