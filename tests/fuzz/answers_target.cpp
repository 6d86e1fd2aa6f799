#include "gap/trial/write/answers.h"
#include "tests/fuzz/target.h"

namespace umbsim::fuzz {

void run_target(const std::uint8_t* data, std::size_t size) {
  const std::string file = written("answers.json", {reinterpret_cast<const char*>(data), size});
  expect_input_error([&] { read_answers(file); });
}

}  // namespace umbsim::fuzz
