#include "gap/search/frontier.h"

#include <algorithm>
#include <utility>

#include "gap/evidence/impulsive_residuals.h"
#include "gap/search/addition.h"

namespace umbsim::gap {
namespace {

constexpr std::size_t kBases = 2;
constexpr double kTwins = 6;            // squared standard deviations between two fits' tracks, all readings
constexpr double kFarBehind = 20;       // log evidence
constexpr double kSuddenBeside = 0.05;  // of what is explained, that another engine leaves of impulses

}  // namespace

bool explains_all(const Model& model, const Fit& fit, const Fit& none, const Thresholds& t) {
  if (fit.misfit >= (1 + t.noise_error) * model.rows()) return false;
  const double explained = fit.log_evidence - none.log_evidence;
  return strongest(find_impulses(model, fit)) < t.sudden + kSuddenBeside * explained;
}

std::vector<Fit> bases(const Model& model, const Fit& none, std::vector<Fit> frontier, const Thresholds& t) {
  std::stable_sort(frontier.begin(), frontier.end(), [](const Fit& a, const Fit& b) { return less_evidence(b, a); });
  std::vector<Fit> from;
  for (Fit& f : frontier) {
    const bool other = std::none_of(from.begin(), from.end(), [&](const Fit& g) {
      return g.name() == f.name() || (g.hypotheses.size() == f.hypotheses.size() && seen_between(model, g, f) < kTwins);
    });
    if (other && from.size() < kBases) from.push_back(std::move(f));
  }
  if (from.size() < 2) return from;
  const bool second_is_idle =
      explains_all(model, from[0], none, t) && from[1].log_evidence < from[0].log_evidence - kFarBehind;
  // Two explanations of what happened at one place or moment are not two.
  if (second_is_idle || (from[0].is_local() && from[1].is_local())) from.resize(1);
  return from;
}

}  // namespace umbsim::gap
