#include <fmt/format.h>

#include <algorithm>

#include "batch/store/store_schema.h"
#include "core/error.h"

namespace umbsim {
namespace {

/// Another database under the name `other`, for the time of the scope.
class Attached {
 public:
  Attached(Database& database, const std::filesystem::path& file) : database_(database) {
    database_.run(fmt::format("ATTACH {} AS other", quoted_text(file.string())));
  }
  ~Attached() {
    try {
      database_.run("DETACH other");
    } catch (const RunError&) {
      // It goes with the connection.
    }
  }
  Attached(const Attached&) = delete;
  Attached& operator=(const Attached&) = delete;

 private:
  Database& database_;
};

// The number under which this store knows the other store's provenance.
std::string translated_provenance(const std::vector<std::string>& names) {
  std::string same;
  for (const std::string& name : names) {
    if (name != "provenance") same += fmt::format(" AND m.{0} = o.{0}", quoted_name(name));
  }
  return "(SELECT m.provenance FROM main.provenance m, other.provenance o WHERE o.provenance = p.provenance" + same +
         ")";
}

}  // namespace

void Store::take_over(const std::filesystem::path& file) {
  {
    // Its own connection first: it repairs what a killed process left, and checks what it is.
    Store other = Store::open(file);
    if (other.layout().definition != layout_.definition || other.layout().figures != layout_.figures) {
      throw InputError(fmt::format("{}: belongs to another sweep than {}", file.string(), this->file()));
    }
  }
  const std::lock_guard lock(*mutex_);
  const Attached attached(*database_, file);
  std::vector<std::string> sources = column_names(*database_, "provenance");
  const std::string provenance = translated_provenance(sources);
  sources.erase(sources.begin());
  std::vector<std::string> before(fixed_columns().begin(), fixed_columns().end() - 1);
  Transaction transaction(*database_);
  database_->run(
      fmt::format("INSERT OR IGNORE INTO main.provenance ({0}) SELECT {0} FROM other.provenance ORDER BY provenance",
                  column_list(sources)));
  // Figures and runs of the points that are new here: before the points, by which they are told.
  database_->run(
      "INSERT INTO main.figures SELECT * FROM other.figures WHERE point NOT IN (SELECT point FROM main.points)");
  database_->run("INSERT INTO main.runs SELECT * FROM other.runs WHERE point NOT IN (SELECT point FROM main.points)");
  database_->run(
      "INSERT INTO main.warnings SELECT * FROM other.warnings WHERE point NOT IN (SELECT point FROM main.points)");
  const std::string axes = layout_.axes.empty() ? "" : ", " + column_list(layout_.axes, "p.");
  database_->run(fmt::format("INSERT OR IGNORE INTO main.points SELECT {}, {}{} FROM other.points p",
                             column_list(before, "p."), provenance, axes));
  database_->run("INSERT OR IGNORE INTO main.starts SELECT * FROM other.starts");
  transaction.commit();
}

}  // namespace umbsim
