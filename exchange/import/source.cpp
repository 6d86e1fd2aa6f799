#include "exchange/import/source.h"

#include <fmt/format.h>

#include <filesystem>

#include "core/error.h"
#include "exchange/bag/bag_source.h"
#include "exchange/text/columns_source.h"
#include "exchange/text/echo_source.h"
#include "exchange/text/trajectory_source.h"

namespace umbsim::exchange {
namespace {

namespace fs = std::filesystem;

std::unique_ptr<Source> open_table(const std::string& file, const ImportOptions& options) {
  Table table = Table::read(file);
  if (EchoSource::looks_like(table)) return std::make_unique<EchoSource>(std::move(table), options);
  // Both have a layout of their own; evo writes TUM files with a commented header.
  const bool asked = file == options.truth_file ? !options.x_column.empty() : !options.left_column.empty();
  const bool tum = TrajectorySource::is_tum(table) && (table.names().empty() || table.names().back() == "qw");
  if (!asked && (tum || (TrajectorySource::is_kitti(table) && table.names().empty()))) {
    return std::make_unique<TrajectorySource>(std::move(table), options);
  }
  return std::make_unique<ColumnsSource>(std::move(table), options);
}

}  // namespace

std::unique_ptr<Source> open_source(const std::string& file, const ImportOptions& options) {
  std::error_code ignored;
  if (!fs::exists(file, ignored)) throw InputError(SourceMark{file}, "cannot be read: no such file");
  const std::vector<std::string> files = bag_files(file);
  if (!files.empty()) return std::make_unique<BagSource>(file, files, options);
  return open_table(file, options);
}

Log read_log(const ImportOptions& options) {
  Log log;
  const std::unique_ptr<Source> source = open_source(options.source, options);
  source->wheels(log);
  if (!options.truth_file.empty()) {
    open_source(options.truth_file, options)->truth(log);
  } else {
    if (!source->has_truth()) {
      throw InputError(fmt::format("{}: holds no truth: give --truth-file", options.source));
    }
    source->truth(log);
  }
  if (log.truth.at.size() < 2) throw InputError(fmt::format("{}: the truth has fewer than two poses", log.truth.name));
  return log;
}

}  // namespace umbsim::exchange
