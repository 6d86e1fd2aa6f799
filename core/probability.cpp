#include "core/probability.h"

#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>

namespace umbsim {

double chi_squared_tail(double chi_squared, double degrees_of_freedom) {
  if (!(chi_squared > 0)) return 1;
  return boost::math::cdf(
      boost::math::complement(boost::math::chi_squared_distribution<double>(degrees_of_freedom), chi_squared));
}

double log_normal_cdf(double x) {
  if (x > -6) return std::log(0.5 * std::erfc(-x / M_SQRT2));
  return -0.5 * x * x - std::log(-x * std::sqrt(2 * M_PI));
}

}  // namespace umbsim
