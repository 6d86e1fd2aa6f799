#include "gap/evidence/model.h"

#include <tbb/parallel_for.h>

#include <Eigen/Cholesky>
#include <atomic>
#include <set>

#include "gap/noise/counts_noise.h"
#include "gap/noise/least_noise.h"
#include "gap/noise/noise_floor.h"
#include "gap/noise/tracker_mount.h"
#include "gap/replay/run_groups.h"
#include "recording/coarse_counts.h"

namespace umbsim::gap {

Model::Model(const Campaign& campaign, Simulator simulator, const Scatter& scatter,
             const std::optional<NoiseModel>& known)
    : campaign_(&campaign), simulator_(std::move(simulator)), scatter_(scatter), noises_(campaign.parts.size()) {
  const Recording& all = recording();
  const Recording& lead = campaign.parts[leading_part(campaign)];
  const double step = count_step(lead);
  step_rad_ = step * 2 * M_PI / all.robot.ticks_per_revolution;
  std::vector<std::vector<Stretch>> of_lead;
  for (std::size_t r = 0; r < all.runs.size(); ++r) {
    const RecordedRun& run = all.runs[r];
    stretches_.push_back(umbsim::stretches(run, all.robot));
    if (&campaign.of(r) == &lead) of_lead.push_back(stretches_.back());
    measured_.counted.push_back(run.has_commands
                                    ? command_response(run, all.robot, counted_rad(run, all.robot), step_rad_)
                                    : CommandResponse{});
  }
  measured_.command_features = measured_command_features(lead, of_lead, step);
  without_effects_ = predict({{}}).front();
  features_sd_ = command_features_sd(lead, measured_.counted, without_effects_.counted);
  nominal_ = beside(campaign, without_effects_.tracks);
  scatter_.gain =
      gain_scatter(grouped(all.runs, nominal_.origin), measured_.counted, without_effects_.counted, scatter.gain);
  const double periods = std::exp(measured_.command_features[3]);  // between two samples
  for (std::size_t i = 0; i < campaign.parts.size(); ++i) {
    const NominalReplay part = part_of(nominal_, campaign, i);
    noises_[i] = known ? NoiseEstimate{*known, false, {}}
                       : estimate_noise(part, least_noise(part, periods / campaign.parts[i].encoder_rate_hz));
  }
  replicated_ = std::all_of(noises_.begin(), noises_.end(), [](const NoiseEstimate& n) { return n.replicated; });
  if (roughness_under({}) != 0) {
    without_effects_ = predict({{}}).front();
    nominal_ = beside(campaign, without_effects_.tracks);
  }
  noise_floor_m_ = gap::noise_floor_m(nominal_, noise_of_runs());
  observe();
}

// The tracks as noise leaves them to be seen, and what is fitted always.
void Model::observe() {
  noise_m2_ = {};
  filters_.clear();
  further_variance_.assign(recording().runs.size(), {});
  for (std::size_t r = 0; r < recording().runs.size(); ++r) {
    filters_.emplace_back(nominal_.tracks[r], nominal_.rolled_m[r], noise(r), nominal_.seen[r], nominal_.velocity[r]);
  }
  const Drive drive = [this](const std::vector<Effect>& effects) { return predict({effects}).front().tracks; };
  std::vector<CountsColumns> counts;
  for (const std::size_t r : all_runs()) counts.push_back(alike_in_counts(r));
  nuisances_ = make_nuisances(nominal_, filters_, scatter_, drive, noise_floor_m_, counts);
  look_without_effects();
  const Evidence seen = evidence(unmoved_.grams, all_runs(), first_columns(nuisances()), nuisances_.shared_sds.front());
  settle_trackers(nuisances_, nominal_, noise_of_runs(), scatter_, seen.mean);
  allow_for_ordinary_floors();
}

// No header says how well the floor holds. A robot that is driven so hard that it slips on an ordinary floor slips
// there otherwise on every such floor, and in every engine.
void Model::allow_for_ordinary_floors() {
  if (slips_at() < scatter_.friction) return;
  const Effect floor{&find_effect("slippery_floor"), {{scatter_.friction}, {}}};
  take_as_unsure(predict({{floor}}).front(), signature_errors_of(floor.info->name));
  whiten_all();
}

std::vector<NoiseModel> Model::noise_of_runs() const {
  std::vector<NoiseModel> of_runs;
  for (const std::size_t r : all_runs()) of_runs.push_back(noise(r));
  return of_runs;
}

std::string Model::condition(std::size_t run) const {
  return std::to_string(campaign_->part_of[run]) + nominal_.conditions[run] + recording().runs[run].direction;
}

bool Model::tracker_is_free() const {
  return std::any_of(campaign_->parts.begin(), campaign_->parts.end(), gap::tracker_is_free);
}

// Each grain of a floor makes wheels that scrub hold or give way. It moves no other robot's mean path.
double Model::roughness_under(const std::vector<Effect>& effects) const {
  if (!simulator_.scrubs || !simulator_.scrubs(effects)) return 0;
  return roughness_m_per_sqrt_m(std::sqrt(noise().heading_rad2_pm), recording().robot.wheelbase_m);
}

std::vector<Predicted> Model::predict(const std::vector<std::vector<Effect>>& sets,
                                      const std::vector<std::size_t>& some) const {
  const std::size_t runs = recording().runs.size();
  const std::vector<std::size_t> driven = some.empty() ? all_runs() : some;
  std::vector<Predicted> all(sets.size());
  for (std::size_t i = 0; i < sets.size(); ++i) {
    all[i].tracks.resize(runs);
    // Without effects on counts the nominal ones stand.
    all[i].counted = without_effects_.counted;
    all[i].counted.resize(runs);
    all[i].command_features = simulator_.command_features ? simulator_.command_features(sets[i]) : CommandFeatures{};
  }
  tbb::parallel_for(std::size_t(0), sets.size() * driven.size(), [&](std::size_t i) {
    const std::size_t set = i / driven.size();
    const std::vector<Effect>& effects = sets[set];
    const std::size_t r = driven[i % driven.size()];
    all[set].tracks[r] = simulate_run(r, effects);
    if (!recording().runs[r].has_commands || !simulator_.commands) return;
    const std::vector<Effect> reaching = reaching_counts(effects);
    if (effects.empty() || !reaching.empty()) {
      all[set].counted[r] =
          command_response(recording().runs[r], recording().robot, simulator_.commands(r, reaching), step_rad_);
    }
  });
  double seconds = 0;
  for (const std::size_t r : driven) seconds += double(sets.size()) * recording().runs[r].encoders.back().time_s;
  std::atomic_ref(simulated_ms_) += std::llround(1000 * seconds);
  return all;
}

// Products of the nuisances with each other are the same for every residual: most of the work, done once.
std::vector<Eigen::MatrixXd> Model::products_of_nuisances() const {
  std::vector<Eigen::MatrixXd> products(nuisances_.shared.size());
  tbb::parallel_for(std::size_t(0), products.size(), [&](std::size_t r) {
    Eigen::MatrixXd all(nuisances_.shared[r].rows(), nuisances() + nuisances_.own_sd[r].size());
    all << nuisances_.shared[r], nuisances_.own[r];
    products[r] = all.transpose() * all;
  });
  return products;
}

std::vector<RunGram> Model::grams(const std::vector<Eigen::VectorXd>& residual,
                                  const std::vector<Eigen::MatrixXd>& columns,
                                  const std::vector<LocalColumns>& local) const {
  std::vector<RunGram> result(recording().runs.size());
  const Eigen::Index shared = nuisances();
  const bool known = columns.empty() && local.empty() && !unmoved_.grams.empty();
  tbb::parallel_for(std::size_t(0), result.size(), [&](std::size_t r) {
    if (residual[r].size() == 0) return;
    if (known && residual[r] == unmoved_.residuals[r]) {
      result[r] = unmoved_.grams[r];
      return;
    }
    const Eigen::Index own = nuisances_.own_sd[r].size();
    const Eigen::Index effects = columns.empty() ? 0 : columns[r].cols();
    const Eigen::Index more = local.empty() ? 0 : local[r].columns.cols();
    const Eigen::Index kept = 1 + shared + effects;
    Eigen::MatrixXd given(residual[r].size(), 1 + effects + more);
    Eigen::VectorXd sd(own + more);
    std::vector<Eigen::Index> at_given{0}, at_nuisances;
    given.col(0) = residual[r];
    if (effects > 0) given.middleCols(1, effects) = columns[r];
    sd.head(own) = nuisances_.own_sd[r];
    if (more > 0) {
      given.rightCols(more) = local[r].columns;
      sd.tail(more) = local[r].prior_sd;
    }
    for (Eigen::Index i = 0; i < effects; ++i) at_given.push_back(1 + shared + i);
    for (Eigen::Index i = 0; i < more; ++i) at_given.push_back(kept + own + i);
    for (Eigen::Index i = 0; i < shared; ++i) at_nuisances.push_back(1 + i);
    for (Eigen::Index i = 0; i < own; ++i) at_nuisances.push_back(kept + i);
    Eigen::MatrixXd cross(given.cols(), shared + own);
    cross << given.transpose() * nuisances_.shared[r], given.transpose() * nuisances_.own[r];
    Eigen::MatrixXd products(kept + own + more, kept + own + more);
    products(at_given, at_given) = given.transpose() * given;
    products(at_given, at_nuisances) = cross;
    products(at_nuisances, at_given) = cross.transpose();
    products(at_nuisances, at_nuisances) = products_of_nuisances_[r];
    result[r] = integrated_out(products, int(kept), sd);
  });
  return result;
}

std::vector<Eigen::VectorXd> Model::left_over(const Fit& fit) const {
  std::vector<Eigen::VectorXd> left = residuals(fit.predicted);
  for (std::size_t r = 0; r < left.size(); ++r) {
    left[r] -= nuisances_.shared[r] * fit.nuisance;
    // The run's own, most likely: ridge regression, with each column scaled by its prior.
    const Eigen::MatrixXd own = nuisances_.own[r] * nuisances_.own_sd[r].asDiagonal();
    Eigen::MatrixXd information = own.transpose() * own;
    information.diagonal().array() += 1;
    left[r] -= own * information.ldlt().solve(own.transpose() * left[r]);
  }
  return left;
}

double Model::rows() const {
  double rows = 0;
  for (const auto& run : nominal_.seen) rows += 3 * double(std::count(run.begin(), run.end(), true));
  return rows;
}

std::vector<std::size_t> Model::all_runs() const {
  std::vector<std::size_t> runs(recording().runs.size());
  for (std::size_t r = 0; r < runs.size(); ++r) runs[r] = r;
  return runs;
}

std::vector<std::size_t> Model::one_of_each() const {
  std::vector<std::size_t> first;
  std::set<std::string> seen;
  for (const std::size_t r : all_runs()) {
    if (seen.insert(condition(r)).second) first.push_back(r);
  }
  return first;
}

}  // namespace umbsim::gap
