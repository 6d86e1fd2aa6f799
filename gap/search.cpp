#include "gap/search.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "gap/noise_floor.h"

namespace umbsim::gap {
namespace {

constexpr std::size_t kSinglesFitted = 7;
constexpr std::size_t kAdditionsFitted = 4;

Eigen::VectorXd start_of(const Family& family) {
  Eigen::VectorXd p(Eigen::Index(family.parameters.size()));
  for (Eigen::Index i = 0; i < p.size(); ++i) p[i] = family.parameters[std::size_t(i)].start;
  return p;
}

// Effects on how the robot is driven and read are tried where counts or commands show them.
bool shown_by_habits(const std::string& effect, const Habits& h) {
  constexpr double kShown = 0.1;
  if (effect == "encoder_sampling") return h[3] > kShown;
  if (effect == "encoder_resolution") return h[4] < -kShown;
  return true;
}

// The leg that a moment belongs to, and the seconds since its start; before the first leg: leg 0.
std::pair<int, double> leg_at(const std::vector<Stretch>& stretches, double time_s) {
  std::pair<int, double> leg{0, 0};
  for (const Stretch& s : stretches) {
    if (s.kind == Stretch::Kind::leg && s.start_s <= time_s) leg = {s.leg, time_s - s.start_s};
  }
  return leg;
}

}  // namespace

Screen::Screen(const Model& model, const std::set<std::string>& excluded) : model_(model), excluded_(excluded) {
  const Recording& recording = model.recording();
  for (const Family& f : plain_families(1 / recording.encoder_rate_hz, recording.robot.ticks_per_revolution)) {
    if (excluded.count(f.effect) == 0 && shown_by_habits(f.effect, model.habits())) families_.push_back(f);
  }
  std::vector<std::vector<Effect>> stepped;
  std::vector<double> steps;
  std::vector<double> sd;
  for (const Family& f : families_) {
    range_.push_back({int(steps.size()), f.from_zero ? int(f.parameters.size()) : 1});
    if (!f.from_zero) {
      stepped.push_back(effects_of(f, start_of(f)));
      steps.push_back(1);
      sd.push_back(1);
      continue;
    }
    for (std::size_t i = 0; i < f.parameters.size(); ++i) {
      Eigen::VectorXd p = start_of(f);
      p[Eigen::Index(i)] += f.parameters[i].step;
      stepped.push_back(effects_of(f, p));
      steps.push_back(f.parameters[i].step);
      sd.push_back(f.parameters[i].prior_sd);
    }
  }
  columns_ = model.columns(model.none().predicted, model.predict(stepped), steps);
  prior_sd_ = Eigen::Map<Eigen::VectorXd>(sd.data(), Eigen::Index(sd.size()));
}

std::vector<Screen::Candidate> Screen::on_top_of(const Fit& fit) const {
  const auto residual = model_.residuals(fit.predicted);
  const Eigen::Index own = fit.p.size();
  std::vector<Eigen::MatrixXd> all(columns_.size());
  for (std::size_t r = 0; r < all.size(); ++r) {
    all[r].resize(columns_[r].rows(), own + columns_[r].cols());
    if (own > 0) all[r].leftCols(own) = fit.columns[r];
    all[r].rightCols(columns_[r].cols()) = columns_[r];
  }
  const std::vector<RunGram> grams = model_.grams(residual, all);
  const int fixed = model_.nuisances() + int(own);
  std::vector<int> base;
  for (int i = 1; i <= fixed; ++i) base.push_back(i);
  Eigen::VectorXd base_sd(fixed);
  base_sd.head(model_.nuisances()) = model_.nuisance_sd();
  Eigen::Index at = model_.nuisances();
  for (const Family& f : fit.families) {
    for (const FreeParameter& p : f.parameters) base_sd[at++] = p.prior_sd;
  }
  Eigen::VectorXd shift = Eigen::VectorXd::Zero(fixed);
  shift.tail(own) = fit.p;
  const auto runs = model_.all_runs();
  const double before = evidence(grams, runs, base, base_sd, shift).log_density;
  std::vector<Candidate> candidates;
  for (std::size_t f = 0; f < families_.size(); ++f) {
    const auto [first, count] = range_[f];
    const bool there = std::any_of(fit.families.begin(), fit.families.end(),
                                   [&](const Family& g) { return g.effect == families_[f].effect; });
    if (there) continue;
    std::vector<int> columns = base;
    Eigen::VectorXd sd(fixed + count);
    sd << base_sd, prior_sd_.segment(first, count);
    Eigen::VectorXd moved = Eigen::VectorXd::Zero(fixed + count);
    moved.head(fixed) = shift;
    for (int i = 0; i < count; ++i) columns.push_back(fixed + 1 + first + i);
    const Evidence e = evidence(grams, runs, columns, sd, moved);
    Candidate c{families_[f], start_of(families_[f]), {}, e.log_density - before};
    if (families_[f].effect == "slippery_floor") c.starts = {0.2, 0.12, 0.08, 0.06, 0.045, 0.035, 0.03};
    for (int i = 0; i < count; ++i) {
      const double mean = e.mean[fixed + i];
      if (!families_[f].from_zero) {
        if (mean < 0) c.gain = -1e9;  // it would have to act backwards
        continue;
      }
      const FreeParameter& p = families_[f].parameters[std::size_t(i)];
      c.start[i] = std::clamp(mean, p.min, p.max);
      if (p.min >= 0 && mean < 0) {
        const double sigmas = mean / std::sqrt(e.covariance(fixed + i, fixed + i));
        c.gain -= 0.5 * sigmas * sigmas;
      }
    }
    candidates.push_back(std::move(c));
  }
  const Kicks kicks = find_kicks(model_, fit);
  const double R = model_.recording().robot.wheel_radius_m;
  const auto offer = [&](Family family, std::vector<double> starts, double gain) {
    if (excluded_.count(family.effect) > 0) return;
    // Two local events at once are not looked for: the second would mend the first one's shape.
    const bool there = std::any_of(fit.families.begin(), fit.families.end(),
                                   [&](const Family& g) { return g.search_cost > 0; });
    if (there) return;
    Eigen::VectorXd p = start_of(family);
    p[0] = starts.front();
    const double cost = family.search_cost;
    candidates.push_back({std::move(family), p, std::move(starts), gain - cost});
  };
  for (std::size_t i = 0; i < std::min<std::size_t>(kicks.places.size(), 2); ++i) {
    const PlaceKick& k = kicks.places[i];
    if (k.gain < 5) break;
    if (k.lost_m > 0) {
      // Closed form of a cable that costs a wheel this distance.
      const double height_m = 0.5 * std::pow(3 * std::sqrt(R) * k.lost_m, 2.0 / 3);
      offer(bump_family(k.x_m, k.y_m, k.heading_rad), {std::clamp(height_m, 0.001, 0.02)}, k.gain);
      offer(lift_family(k.x_m, k.y_m), {0.005, 0.01, 0.03, 0.08, 0.15}, k.gain - 1);
    }
    offer(patch_family(k.x_m, k.y_m), {0.01, 0.03, 0.08}, k.gain - 2);
  }
  if (!kicks.moments.empty() && kicks.moments.front().gain > 5) {
    const Kick& k = kicks.moments.front();
    const RecordedRun& run = model_.recording().runs[k.run];
    const auto [leg, seconds] = leg_at(model_.stretches(k.run), run.truth[k.sample].time_s);
    if (leg > 0) {
      offer(push_family(run.id, leg, std::max(0.0, std::round(seconds * 10 - 1) / 10)),
            {-150, -80, -45, -25, -14, 14, 25, 45, 80, 150}, k.gain);
    }
  }
  std::sort(candidates.begin(), candidates.end(),
            [](const Candidate& a, const Candidate& b) { return a.gain > b.gain; });
  return candidates;
}

double addition_needed(const Model& model, const Fit& base, double none, const Thresholds& t) {
  const double excess = std::max(0.0, base.residual - model.rows());
  return std::max(t.addition + t.addition_share * std::max(0.0, base.log_evidence - none), t.misfit_share * excess / 2);
}

std::vector<Fit> search(const Model& model, const Screen& screen, const Thresholds& thresholds, const Say& say) {
  std::vector<Fit> fits{model.none()};
  say("fitting single effects");
  const auto tried = [&](const Fit base, const Screen::Candidate& c) {
    std::vector<Family> families = base.families;
    families.push_back(c.family);
    Eigen::VectorXd start(base.p.size() + c.start.size());
    start << base.p, c.start;
    try {
      double best = -1e300;
      double chosen = c.start[0];
      for (const double first : c.starts) {
        start[base.p.size()] = first;
        const double density = model.density_at(families, start);
        if (density > best) {
          best = density;
          chosen = first;
        }
      }
      start[base.p.size()] = chosen;
      Fit fit = model.fit(families, start);
      fit.size = displacement_m(fit.predicted.tracks, base.predicted.tracks) / model.noise_floor_m();
      // What moves counts against commands, and not the robot, is seen there.
      if (fit.size < thresholds.smallest && !shows_in_counts(find_effect(c.family.effect))) return;
      fits.push_back(std::move(fit));
    } catch (const RunError&) {
      // A robot that cannot be simulated is no explanation,
    } catch (const InputError&) {
      // nor is one that does not stand at its start, on a cable or without a wheel's floor.
    }
  };
  std::vector<Screen::Candidate> singles = screen.on_top_of(fits.front());
  const double best_gain = singles.empty() ? 0 : singles.front().gain;
  for (std::size_t i = 0; i < singles.size(); ++i) {
    // Where the simulator bends, the screen is only a hint: such families are tried a little longer.
    const double needed = singles[i].family.from_zero ? 2 : 1;
    if (singles[i].gain < needed) continue;
    if (i >= kSinglesFitted && singles[i].gain < best_gain - 15) continue;
    tried(fits.front(), singles[i]);
  }
  const double none = fits.front().log_evidence;
  std::vector<Fit> frontier = fits;
  for (int depth = 2; depth <= thresholds.most_effects; ++depth) {
    std::vector<const Fit*> from;
    for (const Fit& f : frontier) {
      if (int(f.families.size()) == depth - 1) from.push_back(&f);
    }
    std::sort(from.begin(), from.end(), [](const Fit* a, const Fit* b) { return a->log_evidence > b->log_evidence; });
    // Go on from the best, and from a second that is nearly as good or explains something quite different.
    if (from.size() > 2) from.resize(2);
    if (from.empty() || from.front()->log_evidence < none + thresholds.detect) break;
    say(depth == 2 ? "fitting pairs of effects" : "fitting combinations of three");
    std::vector<Fit> next;
    for (const Fit* base : from) {
      const double needed = addition_needed(model, *base, none, thresholds);
      std::size_t fitted = 0;
      for (const Screen::Candidate& c : screen.on_top_of(*base)) {
        // The screen is linear: what falls a little short there may still pay in the simulator.
        if (c.gain < 0.5 * needed || fitted == kAdditionsFitted) break;
        const std::size_t before = fits.size();
        tried(*base, c);
        if (fits.size() == before) continue;
        ++fitted;
        if (fits.back().log_evidence > base->log_evidence + needed) {
          next.push_back(fits.back());
        } else {
          fits.pop_back();
        }
      }
    }
    if (next.empty()) break;
    frontier = std::move(next);
  }
  return fits;
}

}  // namespace umbsim::gap
