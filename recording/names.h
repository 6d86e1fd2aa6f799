#pragma once

#include <string>

namespace umbsim {

/// First line of every recording: its format and version.
constexpr const char* kRecordingFormat = "umbsim-recording/1";

/// What is wrong with a run's id, which becomes the name of its folder; empty if nothing.
std::string run_id_problem(const std::string& id);

/// What is wrong with the path of a file of a recording, which must stay inside the recording's folder; empty if
/// nothing.
std::string inner_path_problem(const std::string& path);

}  // namespace umbsim
