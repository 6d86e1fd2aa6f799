#include "core/first_failure.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include <atomic>
#include <chrono>
#include <stdexcept>
#include <thread>

namespace umbsim {
namespace {

using namespace std::chrono_literals;

TEST(FirstFailure, IsTheFirstByNumber) {
  FirstFailure failure;
  for (const int number : {3, 1, 2}) failure.attempt(std::size_t(number), [&] { throw number; });
  try {
    failure.rethrow();
    FAIL() << "nothing was thrown";
  } catch (const int number) {
    EXPECT_EQ(number, 1);
  }
}

TEST(FirstFailure, LeavesOutWhatIsBehindIt) {
  FirstFailure failure;
  int done = 0;
  failure.attempt(1, [] { throw std::runtime_error("fails"); });
  failure.attempt(0, [&] { ++done; });
  failure.attempt(2, [&] { ++done; });
  EXPECT_EQ(done, 1);
}

// Steps of a loop within one piece that are done although the piece beside it fails while they go on.
int steps_done(bool by_throwing) {
  const tbb::global_control two(tbb::global_control::max_allowed_parallelism, 2);
  std::atomic<int> done = 0;
  std::atomic<bool> begun = false, fails = false;
  const auto wait_for = [](const auto& what) {
    for (int i = 0; i < 10000 && !what(); ++i) std::this_thread::sleep_for(1ms);
  };
  const auto piece = [&](std::size_t i) {
    if (i == 1) {
      begun = true;
      wait_for([&] { return done > 0; });
      fails = true;
      throw std::runtime_error("fails");
    }
    wait_for([&] { return begun.load(); });
    tbb::parallel_for(0, 100, [&](int) {
      if (++done > 1) wait_for([&] { return fails.load(); });
      std::this_thread::sleep_for(1ms);  // until it is known
    });
  };
  FirstFailure failure;
  try {
    tbb::parallel_for(std::size_t(0), std::size_t(2), [&](std::size_t i) {
      if (by_throwing)
        piece(i);
      else
        failure.attempt(i, [&] { piece(i); });
    });
    failure.rethrow();
    ADD_FAILURE() << "nothing failed";
  } catch (const std::runtime_error&) {
  }
  return done;
}

// What is thrown out of a loop cancels the loops within it.
TEST(FirstFailure, PiecesThatHaveBegunAreFinished) {
  if (std::thread::hardware_concurrency() < 2) GTEST_SKIP() << "takes two processors";
  EXPECT_EQ(steps_done(false), 100);
  EXPECT_LT(steps_done(true), 100);
}

}  // namespace
}  // namespace umbsim
