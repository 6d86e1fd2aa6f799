#pragma once

#include <array>
#include <string>
#include <vector>

#include "recording/recording.h"

namespace umbsim::intake {

/// What the checks of a recording share: when a scale is wrong, and what it then may be.
constexpr double kPiece_s = 0.5;    ///< of a run: noise of single readings does not add up
constexpr double kScaleLow = 0.67;  ///< of the tracker's way over the wheels', or of counts over commands
constexpr double kScaleHigh = 1.5;
constexpr double kTurnLow = 0.6;
constexpr double kTurnHigh = 1.6;
constexpr double kWay_m = 0.3;   ///< below, a run says nothing of lengths,
constexpr double kTurn_rad = 1;  ///< nor of angles
constexpr double kDead = 0.01;   ///< of what the other wheel counts

double metres_per_tick(const RecordedRobot& robot);

/// A suspected factor, and what it means.
struct Suspect {
  double factor;
  std::string meaning;
};

/// What the suspect nearest to `ratio` means, or `otherwise` where none is near.
std::string likeliest(double ratio, const std::vector<Suspect>& suspects, const std::string& otherwise);

/// `ratio`: of the way that `whose` lengths say to the wheels'.
std::string why_lengths_differ(double ratio, const RecordedRobot& robot, const std::string& whose);

/// `ratio`: of the truth's turns to the wheels', where lengths agree.
std::string why_turns_differ(double ratio);

/// How the two counters may be wired.
struct Wiring {
  int left_from_left, left_from_right, right_from_left, right_from_right;
  const char* meaning;  ///< empty for the right one
};

/// The first is the right one.
const std::array<Wiring, 6>& wirings();

/// What the counters say of a whole run.
struct Counted {
  double way_m = 0;                ///< without sign
  double turn_rad = 0;             ///< in all
  double left_m = 0, right_m = 0;  ///< without sign
};

Counted counted(const RecordedRun& run, const RecordedRobot& robot, const Wiring& wiring = wirings()[0]);

/// Sums of products of two signals that should be one.
struct Agreement {
  double counted2 = 0, tracked2 = 0, product = 0;
  void add(double counted, double tracked) {
    counted2 += counted * counted;
    tracked2 += tracked * tracked;
    product += counted * tracked;
  }
  /// Correlation, less a tenth of how far (log, at most 3) the scale is from one.
  double score() const;
};

}  // namespace umbsim::intake
