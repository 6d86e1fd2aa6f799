#include "cli/output/pages.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>

#include "cli/output/index_page.h"
#include "core/text/text_file.h"
#include "experiment/output/build_info.h"

extern char** environ;

namespace umbsim {
namespace {

namespace fs = std::filesystem;

bool has_desktop() {
  const auto set = [](const char* name) {
    const char* value = std::getenv(name);
    return value && *value;
  };
  return set("DISPLAY") || set("WAYLAND_DISPLAY");
}

// xdg-open hands the file to the desktop and ends.
bool open_in_browser(const fs::path& page) {
  if (!has_desktop()) return false;
  const std::string file = fs::absolute(page);
  std::string program = "xdg-open", argument = file;
  char* words[] = {program.data(), argument.data(), nullptr};
  posix_spawn_file_actions_t quiet;
  posix_spawn_file_actions_init(&quiet);
  posix_spawn_file_actions_addopen(&quiet, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addopen(&quiet, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  pid_t child = 0;
  const bool begun = posix_spawnp(&child, program.c_str(), &quiet, nullptr, words, environ) == 0;
  posix_spawn_file_actions_destroy(&quiet);
  int status = 0;
  return begun && waitpid(child, &status, 0) == child && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

Json page_of(const std::string& title, const char* key, const Json& json, const Json& provenance) {
  Json page{{"title", title}, {"version", build_info().version}};
  page[key] = json;
  page[key].erase("cost");  // the page is the same bytes on every run
  page["provenance"] = provenance;
  return page;
}

}  // namespace

Json calibration_page(const Json& json, const std::string& name, const Json& provenance) {
  return page_of("Calibration on " + name, "calibration", json, provenance);
}

Json explanation_page(const Json& json, const Json& provenance) {
  return page_of("What causes the return error of " + json.value("scenario", ""), "explanation", json, provenance);
}

Json plan_page(const Json& json, const std::string& name, const Json& provenance) {
  return page_of("Plan: " + name, "plan", json, provenance);
}

Json prediction_page(const Json& json, const std::string& name, const Json& provenance) {
  return page_of("Prediction of " + name, "prediction", json, provenance);
}

void add_open_option(CLI::App* command, bool& open) {
  command->add_flag("--open", open, "Open the page in the desktop's browser");
}

void write_page(const fs::path& into, PageKind kind, const Json& data) {
  if (has_pages()) replace_text_file(into / "report.html", render_report(kind, data));
}

std::string page_said(const std::string& folder) {
  return has_pages() ? fmt::format("open {}/report.html", folder)
                     : "no report.html: this program was built without pages";
}

void finish_page(const std::string& folder, bool open) {
  if (!has_pages()) return;
  write_index_beside(folder);
  if (open && !open_in_browser(fs::path(folder) / "report.html"))
    fmt::print(stderr, "umbsim: there is no desktop with a browser to open the page in\n");
}

}  // namespace umbsim
