// The look back of a forward search: each effect but the last is taken out, and what could stand in its place tried.
#include <algorithm>

#include "gap/search/forward_search.h"
#include "gap/search/frontier.h"

namespace umbsim::gap {
namespace {

constexpr std::size_t kSwapsFitted = 2;
constexpr int kSwaps = 2;
constexpr double kRivals = 0.8;  // share of an effect's gain that the screen must see in another in its place

}  // namespace

// Until the best fit stands, or often enough.
void ForwardSearch::swap(std::vector<Fit>& frontier) {
  std::string swapped;
  for (int i = 0; i < kSwaps; ++i) {
    const Fit best = *std::max_element(frontier.begin(), frontier.end(), less_evidence);
    if (best.name() == swapped) return;
    swapped = best.name();
    swap_one(best, frontier);
  }
}

// The first effect was chosen while the others were not there: each but the last is taken out, and what could stand
// in its place is tried.
void ForwardSearch::swap_one(const Fit& whole, std::vector<Fit>& paying) {
  for (std::size_t out = 0; out + 1 < whole.hypotheses.size(); ++out) {
    const std::size_t known = paying.size();
    exchange(whole, out, paying);
    fits_.insert(fits_.end(), paying.begin() + std::ptrdiff_t(known), paying.end());
  }
}

// Takes effect `out` of `whole` out, and adds what pays in its place to `paying`. The screen is linear: what it sees
// of the effect taken out, if it sees it, is what rivals are held against.
void ForwardSearch::exchange(const Fit& whole, std::size_t out, std::vector<Fit>& paying) {
  const Fit base = model_.without(whole, out);
  fits_.push_back(base);
  const std::string& effect = whole.hypotheses[out].effect;
  const std::vector<Screen::Candidate> candidates = screen_.on_top_of(base);
  double worth = whole.log_evidence - base.log_evidence;
  const auto own = std::find_if(candidates.begin(), candidates.end(),
                                [&](const Screen::Candidate& c) { return c.hypothesis.effect == effect; });
  if (own != candidates.end() && own->reach.size() <= 1) worth = std::min(worth, own->gain);
  std::size_t fitted = 0;
  for (const Screen::Candidate& c : candidates) {
    if (c.hypothesis.effect == effect) continue;
    if (c.gain < kRivals * worth || fitted == kSwapsFitted) break;
    if (c.reach.size() > 1) continue;
    auto fit = tried(base, c, -1e300);
    if (!fit) continue;
    ++fitted;
    if (pays(model_, base, *fit, addition_needed(model_, base, none_, thresholds_))) paying.push_back(std::move(*fit));
  }
}

}  // namespace umbsim::gap
