#pragma once

#include <cstdint>
#include <vector>

namespace umbsim {

enum class Design { grid, list, latin_hypercube, sobol };
const char* name(Design design);

/// `samples` points of the unit cube, as shares of each of `dimensions` axes: point s, axis a at [s * dimensions + a].
/// Latin hypercube: every axis has one point in each of `samples` equal parts, at random within it (McKay, Beckman &
/// Conover 1979).
std::vector<double> latin_hypercube(std::int64_t samples, std::size_t dimensions, std::uint64_t seed);

/// Sobol's sequence (Boost.Random), from its first point after the origin.
std::vector<double> sobol(std::int64_t samples, std::size_t dimensions);

}  // namespace umbsim
