#include "recording/coarse_counts.h"

#include <algorithm>
#include <cmath>
#include <complex>

namespace umbsim {
namespace {

constexpr std::size_t kFewCounts = 50;    // say nothing
constexpr std::size_t kFirstCounts = 30;  // that the coarse look takes in
constexpr std::size_t kCandidates = 200;  // narrow steps that are followed from one look to the next
constexpr double kNarrowest = 1.05;
constexpr double kNarrow = 4.2;     // up to here counts tell by those that never come
constexpr double kUnseen_m = 1e-5;  // a rim's way that no odometry is judged by: narrow steps below it are none
constexpr double kSmallest = 4;     // change of counts from which on these tell by where they lie
constexpr double kFewest = 6;       // counts of a step that rounding does not hide where no two readings are one apart
constexpr double kCoherent = 0.8;
constexpr double kEvery = 0.5;   // the same of changes, which rounding moves by more
constexpr double kSeldom = 0.2;  // share of readings in which a wheel stands that turns by several steps otherwise

// Different counts of the first run's left wheel, without sign, in order.
std::vector<double> different_counts(const Recording& recording) {
  std::vector<double> counts;
  for (const EncoderSample& s : recording.runs.front().encoders) {
    if (s.left_ticks != 0) counts.push_back(double(std::abs(s.left_ticks)));
  }
  std::sort(counts.begin(), counts.end());
  counts.erase(std::unique(counts.begin(), counts.end()), counts.end());
  return counts;
}

double smallest_step(const Recording& recording) {
  double smallest = 1e9;
  const auto& e = recording.runs.front().encoders;
  for (std::size_t i = 1; i < e.size(); ++i) {
    if (e[i].left_ticks == 0 || e[i - 1].left_ticks == 0) continue;
    const double step = std::abs(double(std::abs(e[i].left_ticks) - std::abs(e[i - 1].left_ticks)));
    if (step > 0) smallest = std::min(smallest, step);
  }
  return smallest;
}

// How well counts agree on where between two steps they lie, 0 to 1.
std::complex<double> coherence(const std::vector<double>& counts, double width, double up_to) {
  std::complex<double> sum = 0;
  double n = 0;
  for (const double c : counts) {
    if (c > up_to) break;
    sum += std::polar(1.0, 2 * M_PI * c / width);
    n += 1;
  }
  return n > 10 ? sum / n : 0;
}

// Of the widths in [about - off, about + off], n either way, that in which counts agree best.
double most_coherent(const std::vector<double>& counts, double about, double off, int n, double up_to) {
  double best = about, top = 0;
  for (int i = -n; i <= n; ++i) {
    const double width = about + off * i / n;
    const double value = width > kNarrowest ? std::abs(coherence(counts, width, up_to)) : 0;
    if (value <= top) continue;
    top = value;
    best = width;
  }
  return best;
}

// The step in [about - off, about + off], from a look at the first counts to a finer one at all of them; 1 if there is
// none. Counts from the smallest on.
double step_about(const std::vector<double>& counts, double about, double off) {
  double best = about;
  const double enough = counts[std::min(counts.size() - 1, kFirstCounts)];
  for (double up_to = std::max(about * 12, enough); off > 1e-6 * best; up_to *= 4) {
    // So close that no phase turns by half a radian from one to the next.
    const int n = std::max(40, int(std::min(1e5, off * 12 * up_to / (about * about))));
    best = most_coherent(counts, best, off, n, up_to);
    if (std::abs(coherence(counts, best, up_to)) < kCoherent) return 1;
    if (up_to > counts.back()) break;
    off *= 10.0 / n;
  }
  return std::abs(coherence(counts, best, counts.back())) > kCoherent ? best : 1;
}

// What the left wheel turns from one reading to the next.
std::vector<double> turned(const RecordedRun& run) {
  std::vector<double> turned;
  for (std::size_t i = 1; i < run.encoders.size(); ++i)
    turned.push_back(double(run.encoders[i].left_ticks - run.encoders[i - 1].left_ticks));
  return turned;
}

// Whether a wheel turns by such steps more or less from one reading to the next. At constant speed its counts come as
// regularly as if it turned by any part of what it turns between two readings, but it is uneven by less.
bool uneven_by(const std::vector<double>& turned, double step) {
  std::vector<double> uneven;
  for (std::size_t i = 1; i < turned.size(); ++i) {
    const double by = std::abs(turned[i] - turned[i - 1]);
    if (by >= step / 2) uneven.push_back(by);
  }
  return uneven.size() >= kFewCounts && coherence(uneven, step, 1e300).real() > kEvery;
}

// The widest step of which the smallest change of the counts is a multiple: wheels that are not seen to start or stop
// turn by several steps from one reading to the next.
double wide_step(const std::vector<double>& counts, const std::vector<double>& turned, double smallest) {
  const auto standing = std::count(turned.begin(), turned.end(), 0.0);
  const double most = double(standing) < kSeldom * double(turned.size()) ? smallest / kFewest : 1;
  for (double several = 1; several <= most || several == 1; ++several) {
    const double step = step_about(counts, smallest / several, 1 / several);
    if (step > 1 && uneven_by(turned, step)) return step;
  }
  return 1;
}

struct Candidate {
  double width = 0;
  double evidence = 0;  // log, for counts being multiples of it rather than any
  bool all = false;     // are multiples
};

// Beyond the nearest multiple below, the counts of rounded multiples lie within one count of each other, wherever the
// counter began. As many as say enough are looked at.
Candidate candidate(const std::vector<double>& counts, double width, double up_to) {
  constexpr std::ptrdiff_t kEnough = 250;
  const double miss = std::log(0.05);  // of a width that is nearly right
  const auto end = std::upper_bound(counts.begin(), counts.end(), up_to);
  const std::ptrdiff_t stride = std::max<std::ptrdiff_t>(1, (end - counts.begin()) / kEnough);
  std::vector<double> beyond;
  for (std::ptrdiff_t i = 0; i < end - counts.begin(); i += stride) {
    const double c = counts[std::size_t(i)];
    beyond.push_back(c - std::floor(c / width) * width);
  }
  std::sort(beyond.begin(), beyond.end());
  const std::size_t n = beyond.size();
  std::size_t hits = 0;
  for (std::size_t first = 0, last = 0; first < n; ++first) {
    const auto from_first = [&](std::size_t k) { return beyond[k % n] + (k < n ? 0 : width) - beyond[first]; };
    while (last < first + n && from_first(last) < 1) ++last;
    hits = std::max(hits, last - first);
  }
  return {width, double(hits) * std::log(width) + double(n - hits) * miss, double(hits) > 0.995 * double(n)};
}

// Steps of a few counts: rounding hides where they lie, but some counts never come.
double narrow_step(const std::vector<double>& counts) {
  double up_to = counts[std::min(counts.size() - 1, kFirstCounts)];
  const auto apart = [&] { return 0.05 / up_to; };
  std::vector<Candidate> kept;
  for (double q = kNarrowest; q < kNarrow; q += apart() * q) kept.push_back(candidate(counts, q, up_to));
  while (true) {
    const std::size_t best = std::min(kept.size(), kCandidates);
    std::partial_sort(kept.begin(), kept.begin() + std::ptrdiff_t(best), kept.end(),
                      [](const Candidate& a, const Candidate& b) { return a.evidence > b.evidence; });
    kept.resize(best);
    if (up_to >= 16 * counts.back()) break;  // finer than all counts need, so that none is missed
    const double before = apart();
    up_to *= 4;
    std::vector<Candidate> finer;
    for (const Candidate& c : kept) {
      for (int i = -2; i <= 2; ++i) finer.push_back(candidate(counts, c.width * (1 + before * i / 4), up_to));
    }
    kept = std::move(finer);
  }
  constexpr double kSure = 20;
  if (!kept.front().all || kept.front().evidence < kSure) return 1;
  // Whole multiples fit in with widths that are a little too large.
  const double likeliest = kept.front().width, off = 2 * likeliest * likeliest / counts.back();
  return most_coherent(counts, likeliest, off, 100, counts.back());
}

double rim_m_per_count(const RecordedRobot& robot) {
  return 2 * M_PI * robot.wheel_radius_m / robot.ticks_per_revolution;
}

}  // namespace

double count_step(const Recording& recording) {
  std::vector<double> counts = different_counts(recording);
  if (counts.size() < kFewCounts) return 1;
  // A counter may have been running for long.
  for (auto c = counts.rbegin(); c != counts.rend(); ++c) *c -= counts.front();
  const double smallest = smallest_step(recording);
  if (smallest > 1e6) return 1;
  if (smallest < kSmallest) return kNarrow * rim_m_per_count(recording.robot) < kUnseen_m ? 1 : narrow_step(counts);
  return wide_step(counts, turned(recording.runs.front()), smallest);
}

std::vector<double> steps_counted(const std::vector<EncoderSample>& samples, std::int64_t EncoderSample::*ticks,
                                  double width) {
  std::vector<double> counts;
  for (const EncoderSample& s : samples) counts.push_back(double(s.*ticks));
  const double between = std::arg(coherence(counts, width, 1e300)) / (2 * M_PI) * width;
  for (double& c : counts) c = std::round((c - between) / width);
  return counts;
}

}  // namespace umbsim
