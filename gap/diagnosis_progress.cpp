#include "gap/diagnosis_progress.h"

#include <algorithm>

namespace umbsim::gap {
namespace {

constexpr double kBetweenDraws_s = 0.2;
constexpr double kEnoughToTell = 20;  // simulations, before their speed is known

/// Simulations of each run that a stage usually begins with still to come, from the recordings of docs/gap.md: an
/// effect that is found takes about 260, of which a stage that does not come does not count.
struct Usual {
  const char* stage;
  double left_per_run;
};
constexpr Usual kUsual[] = {{"noise and nuisances", 260},
                            {"signatures of the effects", 250},
                            {"fitting single effects", 200},
                            {"fitting pairs of effects", 90},
                            {"fitting combinations of three", 50},
                            {"held-out runs", 8},
                            {"what no effect explains", 4},
                            {"what could be another effect", 2}};

double usually_left(const std::string& stage) {
  for (const Usual& u : kUsual) {
    if (stage == u.stage) return u.left_per_run;
  }
  return 0;
}

}  // namespace

DiagnosisProgress::DiagnosisProgress(std::size_t runs, Show show)
    : runs_(runs), show_(std::move(show)), start_(std::chrono::steady_clock::now()) {}

double DiagnosisProgress::expected_left() const {
  return std::max(0.0, usually_left(stage_) * double(runs_) - (done_ - done_before_stage_));
}

void DiagnosisProgress::stage(const std::string& name) {
  const std::lock_guard lock(mutex_);
  stage_ = name;
  done_before_stage_ = done_;
  drawn_s_ = -1;
  draw();
}

void DiagnosisProgress::one_more() {
  const std::lock_guard lock(mutex_);
  ++done_;
  draw();
}

void DiagnosisProgress::draw() {
  const double elapsed_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  if (drawn_s_ >= 0 && elapsed_s < drawn_s_ + kBetweenDraws_s) return;
  drawn_s_ = elapsed_s;
  const bool known = done_ >= kEnoughToTell && usually_left(stage_) > 0;
  show_(elapsed_s, stage_, known ? expected_left() * elapsed_s / done_ : -1);
}

Simulator DiagnosisProgress::counted(Simulator simulator) {
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
