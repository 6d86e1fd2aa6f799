#include "calibration/compare/heading_pieces.h"

#include <algorithm>
#include <cmath>

#include "calibration/methods/paths/travel.h"
#include "recording/stretches.h"

namespace umbsim::calibration {
namespace {

constexpr double kShortLeg = 0.3;      // of the longest: no leg of the course
constexpr double kTrim = 0.15;         // of a leg at either end
constexpr double kInPlace = 0.25;      // of the wheelbase: a smaller radius is turning in place
constexpr double kCurvePiece_rad = 1;  // curves are cut into pieces of about this angle
constexpr double kStraight_rad = 0.3;  // a leg that turns more is a curve of a large radius

double tracked_heading(const RecordedRun& run, double time_s) {
  const std::vector<TruthSample>& t = run.truth;
  const auto after =
      std::lower_bound(t.begin(), t.end(), time_s, [](const TruthSample& s, double at) { return s.time_s < at; });
  if (after == t.begin()) return t.front().X_WB.theta_rad;
  if (after == t.end()) return t.back().X_WB.theta_rad;
  const TruthSample& a = *(after - 1);
  const double share = (time_s - a.time_s) / (after->time_s - a.time_s);
  return a.X_WB.theta_rad + share * (after->X_WB.theta_rad - a.X_WB.theta_rad);
}

// One run's pieces between two moments.
class Cutter {
 public:
  Cutter(const TrainingRun& run, std::size_t number, const OdometryParameters& nominal)
      : run_(*run.run), number_(number), nominal_(nominal) {}

  HeadingPiece operator()(double from_s, double to_s) const {
    const std::vector<Travel> at = travel(run_, nominal_, {from_s, to_s});
    return {number_, at[1].left_m - at[0].left_m, at[1].right_m - at[0].right_m,
            tracked_heading(run_, to_s) - tracked_heading(run_, from_s)};
  }

 private:
  const RecordedRun& run_;
  std::size_t number_;
  OdometryParameters nominal_;
};

bool is_leg(const Stretch& s) { return s.kind == Stretch::Kind::leg && std::abs(s.angle_rad) < kStraight_rad; }

double middle_s(const Stretch& s) { return (s.start_s + s.end_s) / 2; }

void cut_legs(const std::vector<Stretch>& all, double start_s, const Cutter& cut, const OdometryParameters& nominal,
              HeadingPieces& pieces) {
  double longest_m = 0;
  for (const Stretch& s : all) {
    if (is_leg(s)) longest_m = std::max(longest_m, std::abs(s.length_m));
  }
  const Stretch* last = nullptr;
  double length_m = 0, angle_rad = 0;  // of what lies between two legs
  for (const Stretch& s : all) {
    if (!is_leg(s) || std::abs(s.length_m) < kShortLeg * longest_m) {
      length_m += std::abs(s.length_m);
      angle_rad += s.angle_rad;
      continue;
    }
    const double trim_s = kTrim * (s.end_s - s.start_s);
    pieces.legs.push_back(cut(s.start_s + trim_s, s.end_s - trim_s));
    if (!last) pieces.first.push_back(cut(start_s, middle_s(s)));
    if (last) pieces.later.push_back(cut(s.start_s, middle_s(s)));
    if (last && length_m < kInPlace * nominal.wheelbase_m * std::abs(angle_rad))
      pieces.turns.push_back(cut(middle_s(*last), middle_s(s)));
    last = &s;
    length_m = angle_rad = 0;
  }
}

void cut_curves(const std::vector<Stretch>& all, const Cutter& cut, const OdometryParameters& nominal,
                HeadingPieces& pieces) {
  for (const Stretch& s : all) {
    if (s.kind == Stretch::Kind::still || std::abs(s.angle_rad) < kCurvePiece_rad) continue;
    if (std::abs(s.length_m) < kInPlace * nominal.wheelbase_m * std::abs(s.angle_rad)) continue;
    const int parts = int(std::abs(s.angle_rad) / kCurvePiece_rad);
    const double step_s = (s.end_s - s.start_s) / parts;
    for (int i = 0; i < parts; ++i) pieces.curves.push_back(cut(s.start_s + i * step_s, s.start_s + (i + 1) * step_s));
  }
}

}  // namespace

HeadingPieces heading_pieces(const Runs& runs, std::size_t recording, const OdometryParameters& nominal) {
  HeadingPieces pieces;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (runs[i].recording_index != recording || !runs[i].tracked()) continue;
    const Cutter cut(runs[i], i, nominal);
    const std::vector<Stretch> all = stretches(*runs[i].run, runs[i].recording->robot);
    const double start_s = runs[i].run->truth.front().time_s;
    pieces.whole.push_back(cut(start_s, runs[i].run->truth.back().time_s));
    cut_legs(all, start_s, cut, nominal, pieces);
    cut_curves(all, cut, nominal, pieces);
  }
  return pieces;
}

}  // namespace umbsim::calibration
