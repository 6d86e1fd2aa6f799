#pragma once

#include "exchange/import/source.h"
#include "exchange/text/columns.h"

namespace umbsim::exchange {

/// A table with a header, as a logger or PlotJuggler writes it. A blank cell is no sample.
class ColumnsSource : public Source {
 public:
  ColumnsSource(Table table, const ImportOptions& options);
  void wheels(Log& log) const override;
  void truth(Log& log) const override;
  bool has_truth() const override;

 private:
  std::size_t time_column() const;
  WheelSignal wheel(std::size_t column, std::size_t time, std::int64_t time_ns) const;
  std::size_t wheel_column(Role role, const std::string& wanted, const std::string& option,
                           const std::string& what) const;
  void commands(Log& log, std::size_t time, std::int64_t time_ns) const;

  Columns columns_;
  const ImportOptions& options_;
};

}  // namespace umbsim::exchange
