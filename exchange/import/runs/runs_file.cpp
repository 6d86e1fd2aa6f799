#include "exchange/import/runs/runs_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "core/error.h"
#include "exchange/text/table.h"
#include "recording/names.h"

namespace umbsim::exchange {

std::vector<Piece> read_runs_file(const std::string& file) {
  const Table table = Table::read(file);
  table.check_even();
  const std::vector<std::string>& names = table.names();
  const auto column = [&](const std::string& name) {
    const auto at = std::find(names.begin(), names.end(), name);
    return at == names.end() ? -1 : int(at - names.begin());
  };
  const int id = column("id"), from = column("from_s"), to = column("to_s"), direction = column("direction");
  if (id < 0 || from < 0 || to < 0)
    table.fail_file("must have the columns id, from_s and to_s, and may have direction");
  std::vector<Piece> pieces;
  std::set<std::string> ids;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    Piece p{std::string(table.cell(row, std::size_t(id))),
            "free",
            table.number(row, std::size_t(from)),
            table.number(row, std::size_t(to)),
            0,
            0};
    const std::string problem = run_id_problem(p.id);
    if (!problem.empty()) table.fail(row, std::size_t(id), fmt::format("'{}' {}", p.id, problem));
    if (!ids.insert(p.id).second) table.fail(row, std::size_t(id), fmt::format("'{}' is an earlier run's", p.id));
    if (!(p.to_s > p.from_s)) {
      table.fail(row, std::size_t(to), fmt::format("{:g} must be > from_s {:g}", p.to_s, p.from_s));
    }
    if (!pieces.empty() && p.from_s < pieces.back().to_s) {
      table.fail(row, std::size_t(from),
                 fmt::format("{:g} must be >= {:g}, the end of {}", p.from_s, pieces.back().to_s, pieces.back().id));
    }
    if (direction >= 0) {
      p.direction = table.cell(row, std::size_t(direction));
      if (p.direction != "cw" && p.direction != "ccw" && p.direction != "free") {
        table.fail(row, std::size_t(direction), fmt::format("'{}' must be cw, ccw or free", p.direction));
      }
    }
    pieces.push_back(p);
  }
  return pieces;
}

}  // namespace umbsim::exchange
