#include "experiment/drive/run_digest.h"

namespace umbsim {

Digester::Digester(const OdometryParameters& odometry, std::size_t truths, std::size_t most_poses)
    : odometry_(odometry), truths_(truths) {
  digest_.stride = 1 + truths / most_poses;
}

void Digester::add(const EncoderSample& row) {
  if (!from_start_) {
    first_ = row;
    from_start_.emplace(odometry_, Pose2{}, row.left_ticks, row.right_ticks);
  }
  from_start_->update(row.left_ticks, row.right_ticks);
  if (on_floor_) on_floor_->update(row.left_ticks, row.right_ticks);
}

void Digester::add(const TruthSample& row, const std::optional<UncertainPose>& estimate,
                   const std::optional<WheelMoment>& wheels) {
  if (!on_floor_) {
    start_ = row.X_WB;
    on_floor_.emplace(odometry_, start_, first_.left_ticks, first_.right_ticks);
  }
  end_ = row.X_WB;
  const bool kept = seen_ % digest_.stride == 0 || seen_ + 1 == truths_;
  ++seen_;
  if (!kept) return;
  digest_.time_s.push_back(row.time_s);
  digest_.truth.push_back(row.X_WB);
  digest_.odometry.push_back(on_floor_->pose());
  if (wheels) digest_.wheels.push_back(*wheels);
  if (estimate) digest_.estimates.push_back(*estimate);
}

RunDigest Digester::finish(const std::string& run) {
  digest_.error = return_error(run, inverse(start_) * end_, from_start_->pose());
  return std::move(digest_);
}

}  // namespace umbsim
