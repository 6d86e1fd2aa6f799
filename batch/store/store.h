#pragma once

#include <filesystem>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "batch/shard.h"
#include "batch/store/sqlite.h"

namespace umbsim {

/// What a store is made for. Columns of its tables; see docs/sweep-database.md.
struct StoreLayout {
  std::string name;
  std::string definition;          ///< all that the results depend on; two stores of one definition may be merged
  std::int64_t points = 0;         ///< how many there are to be
  std::vector<std::string> axes;
  std::vector<std::string> figures;
};

/// Key and value, of the program that drives: version, commit, compiler, ...
using Provenance = std::vector<std::pair<std::string, std::string>>;

struct StoredRun {
  std::string id;
  std::string direction;
  std::string stage;      ///< before | bumped | after
  double x_m = 0;         ///< return error, in the frame of the start
  double y_m = 0;
  double theta_rad = 0;
};

struct StoredPoint {
  std::int64_t number = 0;
  std::int64_t replicate = 0;
  std::int64_t seed = 0;
  std::string error;               ///< why it could not be driven; empty: it was
  std::vector<Cell> axes;          ///< as in the layout
  std::vector<Cell> figures;       ///< as in the layout; nothing where the point has no such figure
  std::vector<StoredRun> runs;
  std::vector<std::string> warnings;  ///< of a point that was driven: what its figures do not say
};

/// One start of the program on a store: history, not content.
struct StoreStart {
  std::string at_utc;
  std::string host;
  std::int64_t pid = 0;
  std::string shard;
};

/// The results of a batch in one SQLite file. A point is there as a whole or not at all, whatever ends the process.
/// Thread-safe; several processes may write into one store.
class Store {
 public:
  /// wal: fast, needs a local disk. rollback: for network file systems too.
  enum class Journal { wal, rollback };

  /// Opens the store, or makes it. Throws InputError if it was made for something else.
  static Store open_for(const std::filesystem::path& file, const StoreLayout& layout, const Provenance& provenance,
                        Journal journal);
  /// Opens a store that is there. Throws InputError if there is none.
  static Store open(const std::filesystem::path& file);

  const StoreLayout& layout() const { return layout_; }
  const std::string& file() const { return database_->file(); }
  /// Whether this very program (its provenance) opened the store before.
  bool knows_program() const { return knows_program_; }
  bool has(std::int64_t number);
  /// Numbers of the points of a shard that are not there yet, in order.
  std::vector<std::int64_t> missing(const Shard& shard);
  std::int64_t count(const char* status);
  void put(const StoredPoint& point);
  /// Point and text, in the order of the points; nothing in a store of a version that kept none.
  std::vector<std::pair<std::int64_t, std::string>> warnings();
  void note_start(const StoreStart& start);
  /// Forgets the points that could not be driven.
  void forget_failed();
  /// Adds the points of another store of the same definition that are not here yet. Throws InputError.
  void take_over(const std::filesystem::path& other);
  /// When all is done: one file without a journal beside it.
  void settle();

  /// Rows of the view `results`, in the order of the points: these columns, where all conditions hold. Throws
  /// InputError that begins with `what` for a column that is not there.
  Statement select(const std::vector<std::string>& columns, const std::vector<Condition>& conditions,
                   const std::string& what);
  /// Names of the columns of `results` that come before axes and figures.
  static const std::vector<std::string>& fixed_columns();
  std::vector<std::string> columns() const;

 private:
  explicit Store(const std::filesystem::path& file, Database::Mode mode);
  void create(const StoreLayout& layout, const Provenance& provenance);
  void read_layout();
  void check_made_for(const StoreLayout& layout) const;
  void find_provenance(const Provenance& provenance);
  void put_figures(const StoredPoint& point);

  std::unique_ptr<Database> database_;
  std::unique_ptr<std::mutex> mutex_ = std::make_unique<std::mutex>();
  StoreLayout layout_;
  std::int64_t provenance_ = 0;
  bool knows_program_ = false;
  std::optional<Statement> has_, put_point_, put_figures_, put_run_, put_warning_;
};

}  // namespace umbsim
