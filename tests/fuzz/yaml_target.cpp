// The strict YAML reader, and the scenario behind it.
#include "core/text/yaml_reader.h"
#include "experiment/scenario/scenario.h"
#include "tests/fuzz/target.h"

namespace umbsim::fuzz {

void run_target(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  expect_input_error([&] { YamlValue::parse(text, "fuzz.yaml"); });
  expect_input_error([&] { read_scenario(written("fuzz.yaml", text)); });
}

}  // namespace umbsim::fuzz
