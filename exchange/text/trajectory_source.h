#pragma once

#include "exchange/import/source.h"
#include "exchange/text/table.h"

namespace umbsim::exchange {

/// Poses only: TUM's `time x y z qx qy qz qw`, or KITTI's twelve numbers, the first three rows of a pose matrix, whose
/// times stand in a file of their own or come at a rate.
class TrajectorySource : public Source {
 public:
  static bool is_tum(const Table& table);
  static bool is_kitti(const Table& table);

  TrajectorySource(Table table, const ImportOptions& options) : table_(std::move(table)), options_(options) {}
  void wheels(Log& log) const override;
  void truth(Log& log) const override;
  bool has_truth() const override { return true; }

 private:
  std::vector<Nanoseconds> kitti_times() const;

  Table table_;
  const ImportOptions& options_;
};

}  // namespace umbsim::exchange
