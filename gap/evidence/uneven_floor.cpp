#include "gap/evidence/uneven_floor.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "gap/evidence/floor_shifts.h"
#include "gap/hypotheses/parametrisations.h"

namespace umbsim::gap {
namespace {

constexpr double kTurned_rad = 1.0;  // headings of passes in different directions differ by more
constexpr double kAlike_rad = 0.2;
constexpr double kBin_m = 0.03;
constexpr int kBins = 24;
constexpr int kLeastBlocks = 4;  // legs of pairs of runs
constexpr double kLeastSigmas = 4;
constexpr double kLeastShare = 0.15;  // of the agreement in one direction that other directions must show
// Of the height's logarithm, whatever the passes agree on: floors of the published trial came out at 0.2 to 1.75 of
// their height, the lower the shorter their waves.
constexpr double kHeightUnsure = 0.6;

/// Means of products of shifts at the same place, each leg of each pair of runs for itself.
struct Agreement {
  std::vector<double> blocks_m2;
  double mean_m2() const {
    double sum = 0;
    for (const double b : blocks_m2) sum += b;
    return blocks_m2.empty() ? 0 : sum / double(blocks_m2.size());
  }
  double sigmas() const {
    double square = 0;
    for (const double b : blocks_m2) square += std::pow(b - mean_m2(), 2);
    const double n = double(blocks_m2.size());
    return mean_m2() / std::sqrt(square / (n * (n - 1)) + 1e-30);
  }
};

enum class Part { whole, across };  // of a shift, seen from the first of two runs

// Between runs that pass alike (turned: in different directions).
Agreement agreement(const std::vector<Passes>& runs, bool turned, Part part) {
  Agreement result;
  for (std::size_t a = 0; a < runs.size(); ++a) {
    for (std::size_t b = a + 1; b < runs.size(); ++b) {
      std::map<int, std::pair<double, int>> legs;
      for (const Shifted& s : runs[a].all()) {
        const Shifted* other = runs[b].nearest(s.X_WB);
        if (!other) continue;
        const double apart = std::abs(std::remainder(s.X_WB.theta_rad - other->X_WB.theta_rad, 2 * M_PI));
        if (turned ? apart < kTurned_rad : apart > kAlike_rad) continue;
        auto& [sum, n] = legs[s.leg];
        const Eigen::Vector2d across(-std::sin(s.X_WB.theta_rad), std::cos(s.X_WB.theta_rad));
        sum +=
            part == Part::across ? s.shift_m.dot(across) * other->shift_m.dot(across) : s.shift_m.dot(other->shift_m);
        ++n;
      }
      for (const auto& [leg, sum] : legs) {
        if (sum.second >= 10) result.blocks_m2.push_back(sum.first / sum.second);
      }
    }
  }
  return result;
}

/// Covariance of shifts (along, across) over the distance between two places of a leg.
struct Covariance {
  std::array<std::array<double, kBins>, 2> m2{};
  std::array<double, kBins> count{};
};

// From pairs of different runs that pass alike: what is random differs.
Covariance covariance_of(const std::vector<Passes>& runs, std::size_t without) {
  Covariance c;
  for (std::size_t a = 0; a < runs.size(); ++a) {
    for (std::size_t b = a + 1; b < runs.size(); ++b) {
      if (a == without || b == without) continue;
      for (const Shifted& s : runs[a].all()) {
        const double ct = std::cos(s.X_WB.theta_rad), st = std::sin(s.X_WB.theta_rad);
        for (int bin = 0; bin < kBins; ++bin) {
          const double d = bin * kBin_m;
          const Shifted* other = runs[b].nearest({s.X_WB.x_m + d * ct, s.X_WB.y_m + d * st, 0});
          if (!other) continue;
          if (std::abs(std::remainder(s.X_WB.theta_rad - other->X_WB.theta_rad, 2 * M_PI)) > kAlike_rad) continue;
          const auto in = [&](const Eigen::Vector2d& f) {
            return Eigen::Vector2d(ct * f.x() + st * f.y(), -st * f.x() + ct * f.y());
          };
          const Eigen::Vector2d u = in(s.shift_m), v = in(other->shift_m);
          c.m2[0][std::size_t(bin)] += u.x() * v.x();
          c.m2[1][std::size_t(bin)] += u.y() * v.y();
          c.count[std::size_t(bin)] += 1;
        }
      }
    }
  }
  for (int bin = 0; bin < kBins; ++bin) {
    for (auto& part : c.m2) part[std::size_t(bin)] /= std::max(1.0, c.count[std::size_t(bin)]);
  }
  return c;
}

// Of a floor of unit rms: an isotropic field of one wavelength has covariance J0(k r). The wheels' slopes shift the
// axle along, the roll across.
std::array<std::array<double, kBins>, 2> expected(double wavelength_m, double height_m, double wheelbase_m) {
  std::array<std::array<double, kBins>, 2> sum{};
  constexpr int kWaves = 5;  // wavelengths scatter by a third
  for (int i = 0; i < kWaves; ++i) {
    const double k = 2 * M_PI / (wavelength_m * (1 + (i - 2) / 6.0));
    const auto J0 = [&](double d, double y) { return std::cyl_bessel_j(0.0, k * std::hypot(d, y)); };
    // -d2/ds2 of J0(k r).
    const auto slopes = [&](double d, double y) {
      const double r = std::hypot(d, y);
      if (r < 1e-9) return k * k / 2;
      const double share = d * d / (r * r);
      const double J1 = std::cyl_bessel_j(1.0, k * r);
      return share * (k * k * std::cyl_bessel_j(0.0, k * r) - k * J1 / r) + (1 - share) * k * J1 / r;
    };
    for (int bin = 0; bin < kBins; ++bin) {
      const double d = bin * kBin_m;
      sum[0][std::size_t(bin)] += height_m * height_m * (slopes(d, 0) + slopes(d, wheelbase_m)) / 2 / kWaves;
      sum[1][std::size_t(bin)] += std::pow(height_m / wheelbase_m, 2) * 2 * (J0(d, 0) - J0(d, wheelbase_m)) / kWaves;
    }
  }
  return sum;
}

// Least squares over both covariances: the rms in closed form, the wavelength by trying.
std::array<double, 2> rms_and_wavelength(const Covariance& c, double height_m, double wheelbase_m) {
  double best = 1e300;
  std::array<double, 2> result{};
  for (double wavelength = 0.08; wavelength < 3; wavelength *= 1.04) {
    const auto unit = expected(wavelength, height_m, wheelbase_m);
    double xy = 0, xx = 0, yy = 0;
    for (std::size_t part = 0; part < 2; ++part) {
      for (std::size_t bin = 0; bin < kBins; ++bin) {
        xy += unit[part][bin] * c.m2[part][bin];
        xx += unit[part][bin] * unit[part][bin];
        yy += c.m2[part][bin] * c.m2[part][bin];
      }
    }
    const double square = yy - (xy > 0 ? xy * xy / xx : 0);
    if (square >= best) continue;
    best = square;
    result = {std::sqrt(std::max(0.0, xy / xx)), wavelength};
  }
  return result;
}

std::vector<Passes> passes(const Model& model, const Fit& fit, bool smooth) {
  std::vector<Passes> runs;
  for (const std::size_t r : model.all_runs()) {
    std::vector<Shifted> shifts = shifts_of(model, fit, r);
    if (smooth) without_ripples(shifts);
    runs.emplace_back(std::move(shifts));
  }
  return runs;
}

}  // namespace

namespace {

// Several recordings need not be of one floor.
bool one_tracked_floor(const Model& model) { return !model.campaign().several() && model.campaign().all_tracked(); }

}  // namespace

bool may_be_uneven_floor(const Model& model, const Fit& fit) {
  if (!one_tracked_floor(model)) return false;
  const std::vector<Passes> smooth = passes(model, fit, true);
  const Agreement alike = agreement(smooth, false, Part::whole);
  const Agreement turned = agreement(smooth, true, Part::whole);
  const bool never_turned = int(turned.blocks_m2.size()) < kLeastBlocks;
  return never_turned && int(alike.blocks_m2.size()) >= kLeastBlocks && alike.sigmas() >= kLeastSigmas;
}

std::optional<UnevenFloorFound> find_uneven_floor(const Model& model, const Fit& fit) {
  if (!one_tracked_floor(model)) return {};
  const std::vector<Passes> runs = passes(model, fit, false);
  const std::vector<Passes> smooth = passes(model, fit, true);
  const double alike_m2 = agreement(smooth, false, Part::whole).mean_m2();
  // The way back has its caster where the way there had none, and pitches otherwise; what is across is the roll's.
  double sigmas = 0;
  for (const Part part : {Part::whole, Part::across}) {
    const Agreement turned = agreement(smooth, true, part);
    const bool enough = int(turned.blocks_m2.size()) >= kLeastBlocks && turned.mean_m2() >= kLeastShare * alike_m2;
    if (enough && alike_m2 > 0) sigmas = std::max(sigmas, turned.sigmas());
  }
  if (sigmas < kLeastSigmas) return {};
  const double height_m = model.recording().robot.wheel_radius_m;
  const double wheelbase_m = model.recording().robot.wheelbase_m;
  UnevenFloorFound found;
  found.sigmas = sigmas;
  const auto all = rms_and_wavelength(covariance_of(runs, runs.size()), height_m, wheelbase_m);
  found.rms_m = all[0];
  found.wavelength_m = all[1];
  // Jackknife.
  for (std::size_t r = 0; r < runs.size(); ++r) {
    const auto some = rms_and_wavelength(covariance_of(runs, r), height_m, wheelbase_m);
    for (std::size_t i = 0; i < 2; ++i) {
      const double difference = std::log(std::max(1e-9, some[i]) / std::max(1e-9, all[i]));
      found.log_sd[i] += difference * difference * double(runs.size() - 1) / double(runs.size());
    }
  }
  for (double& sd : found.log_sd) sd = std::sqrt(sd);
  found.log_sd[0] = std::hypot(found.log_sd[0], kHeightUnsure);
  if (!(found.rms_m > 0)) return {};
  return found;
}

Fit on_uneven_floor(Fit fit, const UnevenFloorFound& floor) {
  const EffectInfo& info = find_effect(kUnevenFloor);
  const EffectValues base = neutral_effect(info).values;
  const std::size_t rms = index_of(info, "rms_m");
  const std::size_t wavelength = index_of(info, "wavelength_m");
  const auto logarithm = [](const char* name) { return FreeParameter{name, 0, 0.1, 3, -14, 3}; };
  Hypothesis hypothesis{
      kUnevenFloor, "roughness", {logarithm("log rms_m"), logarithm("log wavelength_m")}, {}, {}, false, 0};
  hypothesis.shape_unknown = true;
  hypothesis.values = [=](const Eigen::VectorXd& p) {
    EffectValues values = base;
    values.numbers[rms] = std::exp(p[0]);
    values.numbers[wavelength] = std::exp(p[1]);
    return values;
  };
  const Eigen::Index own = fit.p.size();
  fit.hypotheses.push_back(std::move(hypothesis));
  fit.p.conservativeResize(own + 2);
  fit.p.tail(2) << std::log(floor.rms_m), std::log(floor.wavelength_m);
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(own + 2, own + 2);
  covariance.topLeftCorner(own, own) = fit.covariance;
  for (int i = 0; i < 2; ++i) covariance(own + i, own + i) = floor.log_sd[i] * floor.log_sd[i];
  fit.covariance = covariance;
  return fit;
}

}  // namespace umbsim::gap
