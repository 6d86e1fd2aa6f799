#include "sim/model/floor_near.h"

#include <array>
#include <cmath>

namespace umbsim {
namespace {

using Two = Eigen::Array2d;

constexpr double kFar = 0.1;      // of a phase; the series' next terms are below 1e-18
constexpr double kLargest = 1e5;  // of an angle whose multiple of pi is taken off exactly

// 1 / first! - x / (first + 2)! + x^2 / (first + 4)! ...
template <std::size_t kTerms>
class Series {
 public:
  explicit constexpr Series(int first) {
    double factorial = 1;
    for (int i = 2; i <= first; ++i) factorial *= i;
    for (std::size_t i = 0; i < kTerms; ++i, first += 2) {
      term_[i] = (i % 2 ? -1 : 1) / factorial;
      factorial *= (first + 1) * (first + 2);
    }
  }
  Two operator()(const Two& x) const {
    Two sum = Two::Constant(term_[kTerms - 1]);
    for (std::size_t i = kTerms - 1; i-- > 0;) sum = sum * x + term_[i];
    return sum;
  }

 private:
  std::array<double, kTerms> term_{};
};

}  // namespace

void sines_of_two(const Two& angle_rad, Two& sine, Two& cosine) {
  if (!(angle_rad.abs().maxCoeff() < kLargest)) {
    sine = angle_rad.sin();
    cosine = angle_rad.cos();
    return;
  }
  // pi in three parts, the first two of 33 bits (fdlibm's, doubled). Adding and taking off 1.5 * 2^52 rounds.
  constexpr double kPi[] = {2 * 1.57079632673412561417e+00, 2 * 6.07710050630396597660e-11,
                            2 * 2.02226624879595063154e-21};
  constexpr double kRound = 6755399441055744.0;
  constexpr Series<12> kSine(1);
  constexpr Series<12> kCosine(0);
  const Two turns = (angle_rad * M_1_PI + kRound) - kRound;
  const Two rest = ((angle_rad - turns * kPi[0]) - turns * kPi[1]) - turns * kPi[2];
  const Two odd = turns * 0.5 - ((turns * 0.5 + kRound) - kRound);  // +-1/2 for odd numbers of half turns
  const Two sign = 1 - 8 * odd * odd;
  const Two square = rest * rest;
  sine = sign * rest * kSine(square);
  cosine = sign * kCosine(square);
}

FloorBend floor_bend(const Floor& floor, double x_m, double y_m) {
  FloorBend bend;
  for (const Ripple& r : floor.ripples) {
    const double phase = r.kx_radpm * x_m + r.ky_radpm * y_m + r.phase_rad;
    const double slope = -r.amplitude_m * std::sin(phase), up = r.amplitude_m * std::cos(phase);
    bend.at.height_m += up;
    bend.at.slope_x += slope * r.kx_radpm;
    bend.at.slope_y += slope * r.ky_radpm;
    bend.xx_per_m -= up * r.kx_radpm * r.kx_radpm;
    bend.xy_per_m -= up * r.kx_radpm * r.ky_radpm;
    bend.yy_per_m -= up * r.ky_radpm * r.ky_radpm;
  }
  return bend;
}

void FloorNear::move(double x_m, double y_m) {
  x_m_ = x_m;
  y_m_ = y_m;
  const std::size_t count = floor_.ripples.size();
  if (count > kMost) return;
  pairs_ = (count + 1) / 2;
  for (std::size_t i = 0; i < pairs_; ++i) {
    const Ripple& a = floor_.ripples[2 * i];
    const Ripple b = 2 * i + 1 < count ? floor_.ripples[2 * i + 1] : Ripple{};
    kx_[i] = {a.kx_radpm, b.kx_radpm};
    ky_[i] = {a.ky_radpm, b.ky_radpm};
    const Two amplitude_m(a.amplitude_m, b.amplitude_m), phase(a.phase_rad, b.phase_rad);
    sines_of_two(kx_[i] * x_m + ky_[i] * y_m + phase, sine_[i], cosine_[i]);
    sine_[i] *= amplitude_m;
    cosine_[i] *= amplitude_m;
  }
}

FloorBend FloorNear::at(double x_m, double y_m) {
  if (floor_.ripples.size() > kMost) return floor_bend(floor_, x_m, y_m);
  constexpr Series<4> kSine(1);
  constexpr Series<4> kVersine(2);
  const double dx = x_m - x_m_, dy = y_m - y_m_;
  const Two none = Two::Zero();
  Two farthest = none, height = none, slope_x = none, slope_y = none, xx = none, xy = none, yy = none;
  for (std::size_t i = 0; i < pairs_; ++i) {
    const Two d = kx_[i] * dx + ky_[i] * dy, d2 = d * d;
    farthest = farthest.max(d2);
    const Two sine = d * kSine(d2), versine = d2 * kVersine(d2);
    const Two up = cosine_[i] - versine * cosine_[i] - sine * sine_[i];
    const Two slope = versine * sine_[i] - sine_[i] - sine * cosine_[i];
    const Two bend = up * kx_[i];
    height += up;
    slope_x += slope * kx_[i];
    slope_y += slope * ky_[i];
    xx -= bend * kx_[i];
    xy -= bend * ky_[i];
    yy -= up * ky_[i] * ky_[i];
  }
  if (farthest.maxCoeff() > kFar * kFar) {
    move(x_m, y_m);
    return at(x_m, y_m);
  }
  return {{height.sum(), slope_x.sum(), slope_y.sum()}, xx.sum(), xy.sum(), yy.sum()};
}

}  // namespace umbsim
