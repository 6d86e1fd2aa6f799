#include "batch/batch.h"

#include <optional>

#include <tbb/global_control.h>
#include <tbb/parallel_pipeline.h>
#include <tbb/task_arena.h>

#include "batch/stop.h"

namespace umbsim {
namespace {

struct Finished {
  std::int64_t number = -1;
  Batch::Commit commit;
};

/// The next case that nobody else does or has done; those of others are put aside.
class Source {
 public:
  Source(const Batch& batch, Claims& claims, const std::vector<std::int64_t>& open, std::vector<std::int64_t>& aside)
      : batch_(batch), claims_(claims), open_(open), aside_(aside) {}

  std::optional<std::int64_t> next() {
    while (at_ < open_.size() && StopRequests::received() == 0) {
      const std::int64_t number = open_[at_++];
      if (!claims_.take(number)) {
        aside_.push_back(number);
      } else if (batch_.is_done(number)) {
        claims_.release(number);
        batch_.after(number, false);
      } else {
        return number;
      }
    }
    return std::nullopt;
  }

 private:
  const Batch& batch_;
  Claims& claims_;
  const std::vector<std::int64_t>& open_;
  std::vector<std::int64_t>& aside_;
  std::size_t at_ = 0;
};

// Returns the cases that others had claimed.
std::vector<std::int64_t> one_pass(const Batch& batch, Claims& claims, const std::vector<std::int64_t>& open) {
  std::vector<std::int64_t> aside;
  Source source(batch, claims, open, aside);
  const auto take = [&](tbb::flow_control& flow) {
    const auto number = source.next();
    if (!number) flow.stop();
    return number.value_or(-1);
  };
  // Isolated: a thread that waits inside one case must not begin another one meanwhile.
  const auto work = [&](std::int64_t number) {
    return tbb::this_task_arena::isolate([&] { return Finished{number, batch.work(number)}; });
  };
  const auto commit = [&](const Finished& finished) {
    finished.commit();
    claims.release(finished.number);
    batch.after(finished.number, true);
  };
  const auto in_work = std::size_t(tbb::this_task_arena::max_concurrency());
  tbb::parallel_pipeline(in_work,
                         tbb::make_filter<void, std::int64_t>(tbb::filter_mode::serial_in_order, take) &
                             tbb::make_filter<std::int64_t, Finished>(tbb::filter_mode::parallel, work) &
                             tbb::make_filter<Finished, void>(tbb::filter_mode::serial_out_of_order, commit));
  return aside;
}

}  // namespace

bool run_batch(const Batch& batch, Claims& claims, int jobs) {
  std::optional<tbb::global_control> limit;
  if (jobs > 0) limit.emplace(tbb::global_control::max_allowed_parallelism, std::size_t(jobs));
  tbb::task_arena arena(jobs > 0 ? jobs : tbb::task_arena::automatic);
  std::vector<std::int64_t> open = batch.cases;
  while (!open.empty() && StopRequests::received() == 0) {
    open = arena.execute([&] { return one_pass(batch, claims, open); });
    if (!open.empty() && StopRequests::received() == 0) claims.wait_for(open.front());
  }
  return StopRequests::received() == 0;
}

}  // namespace umbsim
