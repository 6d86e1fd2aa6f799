#pragma once

#include <string_view>

/// The files of report/web/, embedded at build time (cmake/EmbedText.cmake).
namespace umbsim::web {

extern const std::string_view page_html;
extern const std::string_view report_css;
extern const std::string_view report_js;
extern const std::string_view sweep_js;
extern const std::string_view gap_js;

}  // namespace umbsim::web
