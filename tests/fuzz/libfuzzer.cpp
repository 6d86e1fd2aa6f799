// Clang's libFuzzer drives a target; see ./run.
#include "tests/fuzz/target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  umbsim::fuzz::run_target(data, size);
  return 0;
}
