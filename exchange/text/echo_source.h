#pragma once

#include "exchange/import/source.h"
#include "exchange/text/table.h"

namespace umbsim::exchange {

/// What `ros2 topic echo --csv TOPIC` wrote: one message a row, every field of it in order, no header.
class EchoSource : public Source {
 public:
  /// Whether the rows begin as such a message does: seconds, nanoseconds, a frame's name.
  static bool looks_like(const Table& table);

  EchoSource(Table table, const ImportOptions& options) : table_(std::move(table)), options_(options) {}
  void wheels(Log& log) const override;
  void truth(Log& log) const override;
  bool has_truth() const override;

 private:
  Table table_;
  const ImportOptions& options_;
};

}  // namespace umbsim::exchange
