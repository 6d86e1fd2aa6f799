#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace umbsim::fuzz {

/// What every target is given. Whatever the bytes are, it ends in peace or with an InputError.
void run_target(const std::uint8_t* data, std::size_t size);

/// A folder in memory of this process, removed at its end.
const std::filesystem::path& folder();

/// A file in it.
std::string written(const std::string& name, std::string_view text);

/// `data` in parts between lines of "====".
std::string_view next_part(std::string_view& data);

/// Runs `work` and takes what a user would be told.
template <class Work>
void expect_input_error(const Work& work);

}  // namespace umbsim::fuzz

#include "core/error.h"

template <class Work>
void umbsim::fuzz::expect_input_error(const Work& work) {
  try {
    work();
  } catch (const InputError&) {
  }
}
