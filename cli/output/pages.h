#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>

#include "experiment/output/result_json.h"
#include "report/report.h"

namespace umbsim {

/// What the pages of these results show: the result's own JSON with a title. `provenance`: page_provenance_json().
Json calibration_page(const Json& calibration, const std::string& name, const Json& provenance);
Json explanation_page(const Json& explanation, const Json& provenance);
Json plan_page(const Json& plan, const std::string& name, const Json& provenance);
Json prediction_page(const Json& prediction, const std::string& name, const Json& provenance);

/// --open
void add_open_option(CLI::App* command, bool& open);

/// Writes `data` as report.html into a folder; nothing where the program was built without pages.
void write_page(const std::filesystem::path& into, PageKind kind, const Json& data);

/// "open FOLDER/report.html", or that there is none.
std::string page_said(const std::string& folder);

/// What comes after a result: the list of results beside it (results/index.html), and with `open` the page in the desktop's
/// browser, where there is one.
void finish_page(const std::string& folder, bool open);

}  // namespace umbsim
