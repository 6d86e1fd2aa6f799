#include "batch/batch.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <filesystem>
#include <mutex>
#include <set>
#include <stdexcept>
#include <thread>

#include "batch/stop.h"

namespace umbsim {
namespace {

using namespace std::chrono_literals;

/// A lock file of its own, and a batch that notes which cases were done.
class RunBatch : public testing::Test {
 protected:
  RunBatch() : file_(testing::TempDir() + "umbsim_batch_" + std::to_string(getpid()) + ".lock") {
    for (std::int64_t i = 0; i < 100; ++i) batch_.cases.push_back(i);
    batch_.is_done = [this](std::int64_t number) {
      const std::lock_guard lock(mutex_);
      return done_.count(number) > 0;
    };
    batch_.work = [this](std::int64_t number) -> Batch::Commit { return [this, number] { commit(number); }; };
    batch_.after = [](std::int64_t, bool) {};
  }
  ~RunBatch() override { std::filesystem::remove(file_); }

  void commit(std::int64_t number) {
    EXPECT_EQ(++committing_, 1) << "one commit at a time";
    {
      const std::lock_guard lock(mutex_);
      EXPECT_TRUE(done_.insert(number).second) << number << " was done twice";
    }
    --committing_;
  }

  std::string file_;
  Batch batch_;
  std::mutex mutex_;
  std::set<std::int64_t> done_;
  std::atomic<int> committing_ = 0;
};

TEST_F(RunBatch, DoesEveryCaseOnceWhateverTheNumberOfJobs) {
  for (const int jobs : {1, 2, 7, 0}) {
    done_.clear();
    Claims claims(file_);
    EXPECT_TRUE(run_batch(batch_, claims, jobs));
    EXPECT_EQ(done_.size(), 100u);
  }
}

TEST_F(RunBatch, LeavesOutWhatIsDoneMeanwhile) {
  done_ = {3, 50};
  std::set<std::int64_t> others;
  batch_.after = [&](std::int64_t number, bool ours) {
    const std::lock_guard lock(mutex_);
    if (!ours) others.insert(number);
  };
  Claims claims(file_);
  EXPECT_TRUE(run_batch(batch_, claims, 2));
  EXPECT_EQ(others, (std::set<std::int64_t>{3, 50}));
  EXPECT_EQ(done_.size(), 100u);
}

TEST_F(RunBatch, WhatAnotherHasClaimedIsTakenOverWhenItEndsWithoutIt) {
  auto other = std::make_unique<Claims>(file_);
  ASSERT_TRUE(other->take(7));
  std::thread ends([&] {
    std::this_thread::sleep_for(100ms);
    const std::lock_guard lock(mutex_);
    EXPECT_EQ(done_.count(7), 0u);
    EXPECT_EQ(done_.size(), 99u) << "all others were not kept waiting";
    other.reset();
  });
  Claims claims(file_);
  EXPECT_TRUE(run_batch(batch_, claims, 2));
  ends.join();
  EXPECT_EQ(done_.size(), 100u);
}

// kill -9 leaves no claim behind.
TEST_F(RunBatch, AClaimEndsWithItsProcess) {
  int ready[2];
  ASSERT_EQ(pipe(ready), 0);
  const pid_t child = fork();
  if (child == 0) {
    Claims claims(file_);
    const char answer = claims.take(5) ? 'y' : 'n';
    if (write(ready[1], &answer, 1) != 1) _exit(1);
    pause();
    _exit(0);
  }
  char answer = 0;
  ASSERT_EQ(read(ready[0], &answer, 1), 1);
  EXPECT_EQ(answer, 'y');
  Claims claims(file_);
  EXPECT_FALSE(claims.take(5));
  EXPECT_TRUE(claims.take(6));
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
  EXPECT_TRUE(claims.take(5));
  close(ready[0]);
  close(ready[1]);
}

TEST_F(RunBatch, ASignalEndsItAfterTheCasesInWork) {
  const StopRequests listen;
  std::atomic<int> begun = 0;
  batch_.work = [&](std::int64_t number) -> Batch::Commit {
    if (++begun == 10) std::raise(SIGINT);
    return [this, number] { commit(number); };
  };
  Claims claims(file_);
  EXPECT_FALSE(run_batch(batch_, claims, 2));
  EXPECT_EQ(StopRequests::received(), SIGINT);
  EXPECT_EQ(done_.size(), std::size_t(begun)) << "what was begun is kept";
  EXPECT_LT(done_.size(), 20u);
}

TEST_F(RunBatch, ExceptionsPassThrough) {
  batch_.work = [&](std::int64_t number) -> Batch::Commit {
    return [number] {
      if (number == 20) throw std::runtime_error("disk full");
    };
  };
  Claims claims(file_);
  EXPECT_THROW(run_batch(batch_, claims, 2), std::runtime_error);
}

}  // namespace
}  // namespace umbsim
