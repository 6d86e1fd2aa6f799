#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace umbsim {

/// First line of every recording: its format and version.
constexpr const char* kRecordingFormat = "umbsim-recording/1";

/// What is wrong with a run's id, which becomes the name of its folder; empty if nothing.
std::string run_id_problem(const std::string& id);

/// Name for a copy of a URDF beside recording.yaml: its own file name, in letters that every file system and YAML take,
/// and with the extension that nothing else in a recording has.
std::string urdf_copy_name(const std::string& urdf);

/// Longest URDF that a recording carries, bytes.
constexpr std::size_t kMaxUrdfBytes = std::size_t(16) << 20;

/// What is wrong with the path of a file of a recording, which must stay inside the recording's folder; empty if
/// nothing.
std::string inner_path_problem(const std::string& path);

/// The same of the file itself, which may be a link: whoever sends a recording must not make its reader open (and show)
/// other files of his.
std::string link_problem(const std::filesystem::path& directory, const std::string& path);

}  // namespace umbsim
