#include "gap/trial/score/statistics.h"

#include <algorithm>
#include <boost/math/distributions/binomial.hpp>
#include <stdexcept>

#include "core/random.h"

namespace umbsim {
namespace {

constexpr double kTail = 0.025;  // of a 95 % interval
constexpr double kOneSidedTail = 0.05;
constexpr int kResamples = 2000;

}  // namespace

Estimate share(int k, int n) {
  if (n == 0) return {0, 0, 1};
  using Binomial = boost::math::binomial_distribution<double>;  // its default interval is Clopper and Pearson's
  return {double(k) / n, Binomial::find_lower_bound_on_p(n, k, kTail), Binomial::find_upper_bound_on_p(n, k, kTail)};
}

double upper_bound(int k, int n) {
  return n == 0 ? 1 : boost::math::binomial_distribution<double>::find_upper_bound_on_p(n, k, kOneSidedTail);
}

double middle(std::vector<double> values) {
  if (values.empty()) throw std::invalid_argument("median of nothing");
  const std::size_t half = values.size() / 2;
  std::nth_element(values.begin(), values.begin() + std::ptrdiff_t(half), values.end());
  if (values.size() % 2) return values[half];
  return (values[half] + *std::max_element(values.begin(), values.begin() + std::ptrdiff_t(half))) / 2;
}

Estimate median(std::vector<double> values) {
  const double value = middle(values);
  RandomStream random(1, "bootstrap of a median");
  std::vector<double> medians, sample(values.size());
  for (int i = 0; i < kResamples; ++i) {
    for (double& v : sample) {
      v = values[std::min(values.size() - 1, std::size_t(random.uniform(0, double(values.size()))))];
    }
    medians.push_back(middle(sample));
  }
  std::sort(medians.begin(), medians.end());
  return {value, medians[std::size_t(kTail * kResamples)], medians[std::size_t((1 - kTail) * kResamples) - 1]};
}

}  // namespace umbsim
