#pragma once

#include <limits>
#include <string>
#include <vector>

#include "effects/catalogue.h"

namespace umbsim::gap {

/// Of the most slippery floor that is ordinary: rubber holds on dry ones by 0.4 to 1.2.
constexpr double kOrdinaryFriction = 0.3;

/// Kinds of effects that errors of a model are taken for, as bits.
enum Looks : unsigned {
  kNothing = 0,
  kSlip = 1,    ///< tyres that slip or creep all the way
  kPlay = 2,    ///< play, and counts that are late
  kPlace = 4,   ///< grip or ground that is missing for a moment, and pushes
  kRadius = 8,  ///< another radius
  kCaster = 16,
};

/// What an effect is to the diagnosis, as bits.
enum Is : unsigned {
  /// It follows from rolling, counting and driving alone, without a contact that slips, scrubs or climbs: another
  /// engine's robot, or a real one, shows it as ours does.
  kKinematic = 1,
  /// One of the three dimensions that every calibration is about: mean radius, ratio of radii, wheelbase.
  kDimension = 2,
  kCommandedMotion = 4,   ///< what was asked of the robot, beyond the course
  kOfAPlace = 8,          ///< searched for at a place, or at a moment
  kDisc = 16,             ///< of these, felt within a radius alone
  kScrubs = 32,           ///< of tyres that nobody knows
  kByChance = 64,         ///< the runs scatter by it
  kByRun = 128,           ///< it grows from run to run
  kLikeADimension = 256,  ///< does what a dimension does, and engines differ in it by no more
  kThreshold = 512,       ///< nothing, until it lets go: tried at several strengths
  kFromWhatShows = 1024,  ///< linear only about what the counts show
  kOfADirection = 2048,   ///< along one direction of the world
};

/// Where the commands and counts show an effect: a number of CommandFeatures, and what it then lies between.
struct ShownBy {
  int feature = -1;  ///< none
  double above = -std::numeric_limits<double>::infinity();
  double below = std::numeric_limits<double>::infinity();
};

/// One line for each effect: all that the diagnosis knows of it besides its physics and its hypotheses.
struct Traits {
  std::string effect;
  /// What the gap goes with: turns, legs, leg_start, place, wheel_angle, world_direction, one_run, runs, load, speed,
  /// reversals, commands.
  std::string pattern;
  unsigned is = 0;
  unsigned looks = kNothing;
  /// How its model may err in another engine, or on other tyres: by this share of what it explains, which then looks
  /// like effects of these kinds. A further effect of such a kind must bring more.
  double error_share = 0;
  unsigned error_looks = kNothing;
  ShownBy shown{};
  /// Of its first number: above this it is as many a robot or floor is, and no header says so. It may be needed beside
  /// a cause, and is none.
  double ordinary_above = std::numeric_limits<double>::infinity();
};

/// Of a name that is no effect's: none at all.
const Traits& traits_of(const std::string& effect);

inline bool is(const std::string& effect, Is what) { return (traits_of(effect).is & what) != 0; }
inline bool is_kinematic(const std::string& effect) { return is(effect, kKinematic); }
inline bool is_dimension(const std::string& effect) { return is(effect, kDimension); }
inline bool is_commanded_motion(const std::string& effect) { return is(effect, kCommandedMotion); }
/// Whether the world decides where it acts, or which way. An engine's contacts are the same everywhere and all round.
inline bool is_of_the_world(const std::string& effect) { return is(effect, kOfAPlace) || is(effect, kOfADirection); }

/// Whether counts against commands, or how the robot was driven and read, show the effect; others only move the robot.
bool shows_in_counts(const EffectInfo& info);

/// Those of which counts may show something: all, if any is between motors and wheels, else those that show in counts.
/// Shafts turn as they are told then, whatever the robot does, unless a motor reaches its torque limit.
std::vector<Effect> reaching_counts(std::vector<Effect> effects);

/// Whether it acts at a contact or on the floor, and is neither kinematic nor seen in the counts: what an engine's
/// contacts make of it is its own.
bool is_contact(const std::string& effect);

}  // namespace umbsim::gap
