// A sweep's database, opened and exported.
#include "batch/store/store.h"
#include "batch/store/store_export.h"
#include "tests/fuzz/target.h"

namespace umbsim::fuzz {

void run_target(const std::uint8_t* data, std::size_t size) {
  const std::string file = written("sweep.sqlite", {reinterpret_cast<const char*>(data), size});
  expect_input_error([&] {
    Store store = Store::open(file);
    store.warnings();
    ExportChoice choice;
    choice.file = folder() / "out.csv";
    export_store(store, choice);
  });
}

}  // namespace umbsim::fuzz
