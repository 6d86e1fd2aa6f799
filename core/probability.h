#pragma once

namespace umbsim {

/// Probability of a larger chi-squared.
double chi_squared_tail(double chi_squared, double degrees_of_freedom);

/// log of the standard normal's distribution function, also far below zero.
double log_normal_cdf(double x);

}  // namespace umbsim
