#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace umbsim {

/// How many characters were mistyped: left out, added, replaced, or two neighbours exchanged.
int edit_distance(const std::string& a, const std::string& b);

/// Of `choices` the one that was probably meant: the same but for case and hyphens, the end of a key path, begun alike,
/// or mistyped in at most a third of its characters. Nothing where none is near.
std::optional<std::string> nearest(const std::string& wrong, const std::vector<std::string>& choices);

/// "did you mean 'wheelbase'? " where one is near, else "".
std::string did_you_mean(const std::string& wrong, const std::vector<std::string>& choices);

/// The first `count` of `choices`, the least mistyped first.
std::vector<std::string> nearest_few(const std::string& wrong, std::vector<std::string> choices, std::size_t count);

}  // namespace umbsim
