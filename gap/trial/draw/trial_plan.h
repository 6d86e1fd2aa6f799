#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "effects/catalogue.h"
#include "recording/recording.h"

namespace umbsim {

/// A range that is drawn from.
struct Range {
  double min = 0;
  double max = 0;
};

/// How many cases of each tier.
struct TierSizes {
  int no_effect = 0;
  int single = 0;      ///< one effect, the recommended set of runs
  int pairs = 0;       ///< two effects
  int outside = 0;     ///< one effect that the diagnosis is told to leave out of its catalogue
  int end_points = 0;  ///< one effect, absolute poses at start and end only
  int poor_runs = 0;   ///< one effect, only the plain runs
};

/// The robots and courses of a trial. A case takes one of `count` platforms, so that signatures can be cached.
struct PlatformRanges {
  int count = 3;
  Range wheel_radius_m{0.06, 0.10};
  Range wheelbase_m{0.30, 0.45};
  Range base_mass_kg{25, 55};
  Range caster_ahead_m{0.20, 0.32};
  Range mass_centre_share{0.15, 0.35};    ///< of the way from the axle to the caster
  Range mass_centre_height_m{0.03, 0.10}; ///< above the axle
  Range ticks_per_revolution{1500, 4000};
  Range side_m{3, 4};
  Range linear_speed_mps{0.18, 0.25};
  Range angular_speed_radps{0.6, 0.8};
};

/// The random errors of every recording, and how they differ from case to case.
struct TrialNoise {
  double heading_walk_rad_per_sqrt_m = 0.0006;  ///< of a straight leg
  double radius_scatter = 5e-5;                 ///< relative, from run to run
  double motor_scatter = 4e-4;                  ///< of each motor's relative gain, from run to run
  double position_sd_m = 0.0003;                ///< of the absolute pose
  double heading_sd_rad = 0.0003;
  Range level{0.7, 1.4};                        ///< all five are multiplied by this
};

/// One run of the recommended set.
struct PlannedRun {
  std::string id;
  std::string direction;         ///< cw | ccw
  double start_heading_rad = 0;
  double speed_factor = 1;       ///< of the platform's linear speed
  double turn_radius_m = 0;      ///< 0: turns in place; else rolling turns
  double payload_kg = 0;         ///< the experimenter's own, written into the recording
  bool plain() const { return start_heading_rad == 0 && speed_factor == 1 && turn_radius_m == 0 && payload_kg == 0; }
};

/// cw and ccw twice, then both with a rotated start, fast, with a payload and with rolling turns.
std::vector<PlannedRun> recommended_runs();

/// A trial as its file describes it. The same file gives the same cases, to the byte.
struct TrialPlan {
  std::string file;
  std::string name;
  std::string description;
  std::uint64_t seed = 1;
  TierSizes cases;
  std::vector<const EffectInfo*> effects;  ///< that are drawn; default: the whole catalogue
  Range severity{0.5, 10};                 ///< in units of the noise floor, drawn log-uniformly
  double decoy_exclusions = 0.25;          ///< share of the other cases that leave out an innocent effect
  PlatformRanges platforms;
  TrialNoise noise;
  std::vector<PlannedRun> runs = recommended_runs();
};

/// Reads a trial file as strictly as a scenario. Throws InputError with file, line, column, key, value and bound.
TrialPlan read_trial(const std::string& file);

/// Every value written out, in the form that read_trial takes.
std::string resolved_trial(const TrialPlan& plan);

}  // namespace umbsim
