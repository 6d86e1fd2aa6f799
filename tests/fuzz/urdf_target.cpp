#include "sim/model/robot_model.h"
#include "tests/fuzz/target.h"

namespace umbsim::fuzz {

void run_target(const std::uint8_t* data, std::size_t size) {
  const std::string file = written("fuzz.urdf", {reinterpret_cast<const char*>(data), size});
  expect_input_error([&] { load_robot(file); });
}

}  // namespace umbsim::fuzz
