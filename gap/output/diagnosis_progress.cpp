#include "gap/output/diagnosis_progress.h"

#include <algorithm>

namespace umbsim::gap {
namespace {

constexpr double kBetweenDraws_s = 0.2;

}  // namespace

DiagnosisProgress::DiagnosisProgress(std::size_t runs, std::vector<UsualStage> usual, Show show)
    : runs_(double(runs)),
      show_(std::move(show)),
      start_(std::chrono::steady_clock::now()),
      stage_(usual.empty() ? "" : usual.front().name),
      estimate_(std::move(usual)) {}

double DiagnosisProgress::elapsed_s() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

void DiagnosisProgress::stage(const std::string& name, double share) {
  const std::lock_guard lock(mutex_);
  const bool is_new = name != stage_;
  if (is_new) simulated_ = 0;
  stage_ = name;
  estimate_.reached(name, share, elapsed_s());
  draw(is_new);
}

void DiagnosisProgress::finish() {
  const std::lock_guard lock(mutex_);
  estimate_.finished();
  draw(true);
}

void DiagnosisProgress::one_more() {
  const std::lock_guard lock(mutex_);
  ++simulated_;
  const UsualStage* usual = estimate_.current();
  if (usual && usual->name == stage_ && usual->simulations_per_run > 0) {
    estimate_.reached(stage_, simulated_ / (usual->simulations_per_run * runs_), elapsed_s());
  }
  draw(false);
}

void DiagnosisProgress::draw(bool at_once) {
  const double now_s = elapsed_s();
  if (!at_once && now_s < drawn_s_ + kBetweenDraws_s) return;
  drawn_s_ = now_s;
  const double fraction = estimate_.fraction(now_s);
  show_({stage_, now_s, fraction, fraction < 1 ? estimate_.left_s(now_s) : 0});
}

Simulator DiagnosisProgress::counted(const Simulator& simulator) {
  Simulator result = simulator;
  result.ticks = [this, ticks = simulator.ticks](std::size_t run, const std::vector<Effect>& effects,
                                                 double roughness_m_per_sqrt_m) {
    auto track = ticks(run, effects, roughness_m_per_sqrt_m);
    one_more();
    return track;
  };
  return result;
}

}  // namespace umbsim::gap
