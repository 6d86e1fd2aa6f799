#pragma once

#include <string_view>

/// What is built from report/web/, embedded at build time (cmake/EmbedFile.cmake).
namespace umbsim::web {

extern const std::string_view page_html;
extern const std::string_view replay_js;

}  // namespace umbsim::web
