#include "cli/output/answer.h"

#include <fmt/format.h>

#include "cli/output/colour.h"
#include "core/terminal.h"

namespace umbsim {

void add_answer_options(CLI::App* command, Answer& answer, const std::string& file) {
  CLI::Option* quiet = command->add_flag_callback(
      "-q,--quiet",
      [&answer] {
        answer.quiet = true;
        hide_progress();
      },
      "Print nothing but errors");
  command
      ->add_flag("--json", answer.json,
                 fmt::format("Print {} on standard output and nothing else; without --out no folder is written", file))
      ->excludes(quiet);
}

void print_answer(const Answer& answer, const std::string& words, const nlohmann::ordered_json& json) {
  if (answer.json)
    fmt::print("{}\n", json.dump(2));
  else if (!answer.quiet)
    print_words(words);
}

}  // namespace umbsim
