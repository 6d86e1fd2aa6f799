#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "core/sha256.h"
#include "gap/trial/write/trial_folder.h"

namespace umbsim {

/// More than any trial's answers take.
constexpr std::size_t kMaxAnswerBytes = 256 * 1024 * 1024;

/// The hash that seals the answers of a trial, from answers.sha256 (the format of sha256sum); nothing if there is none.
std::optional<std::string> read_seal(const TrialFolder& folder);

/// Writes the answers and then their hash. Returns the hash.
std::string seal_answers(const TrialFolder& folder, const std::string& answers);

/// Whether the answers file is the one that was sealed. Throws InputError if it was changed since; false if it was
/// never sealed.
bool check_seal(const std::filesystem::path& answers, const std::optional<std::string>& sealed_hash);

}  // namespace umbsim
