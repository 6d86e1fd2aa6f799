#include <fmt/format.h>

#include <memory>
#include <string>

#include "cli/commands.h"
#include "cli/help/completion_text.h"
#include "cli/help/help.h"
#include "experiment/output/build_info.h"

namespace umbsim {

void add_completion_command(CLI::App& app) {
  const auto kind = std::make_shared<std::string>();
  CLI::App* command = app.add_subcommand(
      "completion", "Print completion for bash or zsh, or the manual page, for your system's folders");
  command->add_option("kind", *kind, "bash, zsh or man")->required()->check(CLI::IsMember({"bash", "zsh", "man"}));
  add_example(command, "umbsim completion bash");
  command->callback([kind, &app] {
    const std::string text = *kind == "bash"  ? bash_completion(app)
                             : *kind == "zsh" ? zsh_completion(app)
                                              : manual_page(app, build_info().version);
    fmt::print("{}", text);
  });
}

}  // namespace umbsim
