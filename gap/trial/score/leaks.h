#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace umbsim {

/// How often labels are guessed, against chance.
struct LeakFigure {
  int cases = 0;
  double accuracy = 0;
  double chance = 0;   ///< mean accuracy over permutations of the labels
  double p_value = 1;  ///< share of permutations that do as well; small: there is a leak
};

/// Numbers about a recording that are not its data: bytes and rows of its files, bytes per row, its name, its times.
std::vector<double> metadata(const std::filesystem::path& recording);

/// Guesses each case's label from its nearest neighbours by metadata, leaving the case itself out; features count in
/// units of their own spread.
LeakFigure metadata_leak(const std::vector<std::vector<double>>& features, const std::vector<std::string>& labels);

/// The answers dealt out at random again: `accuracy` is that of the diagnosis with the true answers.
LeakFigure shuffled_labels(const std::vector<std::string>& truths, const std::vector<std::string>& named);

}  // namespace umbsim
