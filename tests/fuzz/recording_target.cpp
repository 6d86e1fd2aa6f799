// recording.yaml, encoders.csv and truth.csv, parted by lines of "====", as calibration and diagnosis take them in.
#include "calibration/intake/intake.h"
#include "tests/fuzz/target.h"

namespace umbsim::fuzz {

void run_target(const std::uint8_t* data, std::size_t size) {
  std::string_view rest(reinterpret_cast<const char*>(data), size);
  written("r/recording.yaml", next_part(rest));
  written("r/runs/a/e.csv", next_part(rest));
  written("r/runs/a/t.csv", next_part(rest));
  expect_input_error([&] { intake::take_in((folder() / "r").string()); });
}

}  // namespace umbsim::fuzz
