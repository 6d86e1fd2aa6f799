#include "exchange/import/imported.h"
#include "tests/fuzz/target.h"

namespace umbsim::fuzz {

void run_target(const std::uint8_t* data, std::size_t size) {
  exchange::ImportOptions options;
  options.source = written("fuzz.bag", {reinterpret_cast<const char*>(data), size});
  options.wheel_radius_m = 0.033;
  options.wheelbase_m = 0.16;
  options.ticks_per_revolution = 4096;
  expect_input_error([&] { exchange::import_recording(options); });
}

}  // namespace umbsim::fuzz
