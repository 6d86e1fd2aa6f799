#include "batch/store/store.h"

#include <fmt/format.h>

#include <algorithm>

#include "batch/store/store_schema.h"
#include "core/error.h"
#include "core/text/yaml_reader.h"

namespace umbsim {
namespace {

std::string placeholders(std::size_t count) {
  std::string text;
  for (std::size_t i = 0; i < count; ++i) text += i == 0 ? "?" : ", ?";
  return text;
}

bool is_new(Database& database) {
  return number_of(database.value("PRAGMA user_version")) == 0 &&
         number_of(database.value("SELECT count(*) FROM sqlite_schema")) == 0;
}

void check_is_store(Database& database) {
  if (number_of(database.value("PRAGMA application_id")) != double(kStoreApplication)) {
    throw InputError(fmt::format("{}: is not a sweep's database", database.file()));
  }
  const double version = number_of(database.value("PRAGMA user_version"));
  if (version != double(kStoreVersion)) {
    throw InputError(
        fmt::format("{}: has version {} of the tables (must be {})", database.file(), version, kStoreVersion));
  }
}

// The columns of a table behind those that every sweep's has.
std::vector<std::string> columns_behind(Database& database, const std::string& table,
                                        const std::vector<std::string>& fixed) {
  const std::vector<std::string> all = column_names(database, table);
  if (all.size() < fixed.size() || !std::equal(fixed.begin(), fixed.end(), all.begin()))
    throw InputError(fmt::format("{}: is damaged: its table '{}' has other columns", database.file(), table));
  return {all.begin() + std::ptrdiff_t(fixed.size()), all.end()};
}

}  // namespace

const std::vector<std::string>& Store::fixed_columns() {
  static const std::vector<std::string> names{"point", "replicate", "point_seed", "status", "error", "provenance"};
  return names;
}

Store::Store(const std::filesystem::path& file, Database::Mode mode)
    : database_(std::make_unique<Database>(file, mode)) {}

Store Store::open_for(const std::filesystem::path& file, const StoreLayout& layout, const Provenance& provenance,
                      Journal journal) {
  Store store(file, Database::Mode::write);
  Database& database = *store.database_;
  if (is_new(database)) {
    database.run(journal == Journal::wal ? "PRAGMA journal_mode = WAL" : "PRAGMA journal_mode = TRUNCATE");
    store.create(layout, provenance);
  }
  check_is_store(database);
  store.read_layout();
  store.check_made_for(layout);
  database.run(journal == Journal::wal ? "PRAGMA journal_mode = WAL; PRAGMA synchronous = NORMAL"
                                       : "PRAGMA journal_mode = TRUNCATE; PRAGMA synchronous = FULL");
  store.find_provenance(provenance);
  const std::size_t axes = layout.axes.size(), figures = layout.figures.size();
  store.has_ = database.prepare("SELECT 1 FROM points WHERE point = ?");
  store.put_point_ = database.prepare("INSERT OR IGNORE INTO points VALUES (" + placeholders(6 + axes) + ")");
  store.put_figures_ = database.prepare("INSERT INTO figures VALUES (" + placeholders(1 + figures) + ")");
  store.put_run_ = database.prepare("INSERT INTO runs VALUES (?, ?, ?, ?, ?, ?, ?)");
  store.put_warning_ = database.prepare("INSERT INTO warnings VALUES (?, ?, ?)");
  return store;
}

Store Store::open(const std::filesystem::path& file) {
  if (!std::filesystem::exists(file)) throw InputError(fmt::format("{}: there is no such file", file.string()));
  Store store(file, Database::Mode::read);
  check_is_store(*store.database_);
  store.read_layout();
  store.has_ = store.database_->prepare("SELECT 1 FROM points WHERE point = ?");
  return store;
}

void Store::create(const StoreLayout& layout, const Provenance& provenance) {
  Transaction transaction(*database_);
  // Another process may have made it since.
  if (is_new(*database_)) database_->run(schema_sql(layout, provenance));
  transaction.commit();
}

void Store::read_layout() {
  layout_.name = text_of_cell(database_->value("SELECT value FROM sweep WHERE key = 'name'"));
  layout_.definition = text_of_cell(database_->value("SELECT value FROM sweep WHERE key = 'definition'"));
  const Cell points = database_->value("SELECT value FROM sweep WHERE key = 'points'");
  const std::int64_t* count = std::get_if<std::int64_t>(&points);
  if (!count || *count < 0) throw InputError(fmt::format("{}: is damaged: it has no number of points", file()));
  layout_.points = *count;
  layout_.axes = columns_behind(*database_, "points", fixed_columns());
  layout_.figures = columns_behind(*database_, "figures", {"point"});
}

void Store::check_made_for(const StoreLayout& wanted) const {
  const char* what = nullptr;
  if (layout_.definition != wanted.definition)
    what = "another scenario, other axes or other changes";
  else if (layout_.figures != wanted.figures)
    what = "another version of the program, with other figures";
  if (!what) return;
  throw InputError(fmt::format("{}: holds a sweep with {}; use --force to begin anew, or --out for another folder",
                               database_->file(), what));
}

void Store::find_provenance(const Provenance& provenance) {
  std::vector<std::string> names;
  for (const auto& [name, value] : provenance) names.push_back(name);
  std::string where;
  for (const std::string& name : names) where += (where.empty() ? "" : " AND ") + quoted_name(name) + " = ?";
  Transaction transaction(*database_);
  Statement insert = database_->prepare(
      fmt::format("INSERT OR IGNORE INTO provenance ({}) VALUES ({})", column_list(names), placeholders(names.size())));
  Statement find = database_->prepare("SELECT provenance FROM provenance WHERE " + where);
  for (std::size_t i = 0; i < names.size(); ++i) {
    insert.bind(int(i), provenance[i].second);
    find.bind(int(i), provenance[i].second);
  }
  knows_program_ = find.step();
  find.reset();
  insert.run();
  if (find.step()) provenance_ = find.integer(0);
  find.reset();
  transaction.commit();
}

bool Store::has(std::int64_t number) {
  const std::lock_guard lock(*mutex_);
  const bool found = has_->bind(0, number).step();
  has_->reset();
  return found;
}

std::vector<std::int64_t> Store::missing(const Shard& shard) {
  const std::lock_guard lock(*mutex_);
  std::vector<std::int64_t> open;
  Statement there = database_->prepare("SELECT point FROM points ORDER BY point");
  bool more = there.step();
  for (std::int64_t number = 0; number < layout_.points; ++number) {
    const bool found = more && there.integer(0) == number;
    if (found)
      more = there.step();
    else if (shard.has(number))
      open.push_back(number);
  }
  return open;
}

std::int64_t Store::count(const char* status) {
  const std::lock_guard lock(*mutex_);
  Statement rows = database_->prepare("SELECT count(*) FROM points WHERE status = ?");
  rows.bind(0, std::string(status)).step();
  return rows.integer(0);
}

void Store::put(const StoredPoint& point) {
  const std::lock_guard lock(*mutex_);
  Transaction transaction(*database_);
  const bool failed = !point.error.empty();
  put_point_->bind(0, point.number).bind(1, point.replicate).bind(2, point.seed);
  put_point_->bind(3, std::string(failed ? "failed" : "done")).bind(4, failed ? Cell(point.error) : Cell());
  put_point_->bind(5, provenance_);
  for (std::size_t i = 0; i < point.axes.size(); ++i) put_point_->bind(int(6 + i), point.axes[i]);
  put_point_->run();
  const bool is_first = number_of(database_->value("SELECT changes()")) == 1;
  if (is_first && !failed) put_figures(point);
  transaction.commit();
}

void Store::put_figures(const StoredPoint& point) {
  put_figures_->bind(0, point.number);
  for (std::size_t i = 0; i < point.figures.size(); ++i) put_figures_->bind(int(1 + i), point.figures[i]);
  put_figures_->run();
  for (const StoredRun& r : point.runs) {
    put_run_->bind(0, point.number).bind(1, r.id).bind(2, r.direction).bind(3, r.stage);
    put_run_->bind(4, r.x_m).bind(5, r.y_m).bind(6, r.theta_rad).run();
  }
  for (std::size_t i = 0; i < point.warnings.size(); ++i) {
    put_warning_->bind(0, point.number).bind(1, std::int64_t(i)).bind(2, point.warnings[i]).run();
  }
}

std::vector<std::pair<std::int64_t, std::string>> Store::warnings() {
  const std::lock_guard lock(*mutex_);
  std::vector<std::pair<std::int64_t, std::string>> all;
  if (column_names(*database_, "warnings").empty()) return all;
  Statement rows = database_->prepare("SELECT point, warning FROM warnings ORDER BY point, number");
  while (rows.step()) all.emplace_back(rows.integer(0), rows.text(1));
  return all;
}

void Store::note_start(const StoreStart& start) {
  const std::lock_guard lock(*mutex_);
  Statement insert = database_->prepare("INSERT OR IGNORE INTO starts VALUES (?, ?, ?, ?)");
  insert.bind(0, start.at_utc).bind(1, start.host).bind(2, start.pid).bind(3, start.shard).run();
}

void Store::forget_failed() {
  const std::lock_guard lock(*mutex_);
  database_->run("DELETE FROM points WHERE status = 'failed'");
}

void Store::settle() {
  const std::lock_guard lock(*mutex_);
  try {
    database_->value("PRAGMA journal_mode = DELETE");  // not `run`, which would wait for the other one
  } catch (const RunError&) {
    // Another process still has it open, and will do it.
  }
}

std::vector<std::string> Store::columns() const {
  std::vector<std::string> names = fixed_columns();
  names.insert(names.end(), layout_.axes.begin(), layout_.axes.end());
  names.insert(names.end(), layout_.figures.begin(), layout_.figures.end());
  return names;
}

Statement Store::select(const std::vector<std::string>& wanted, const std::vector<Condition>& conditions,
                        const std::string& what) {
  const std::vector<std::string> known = columns();
  const auto check = [&](const std::string& name) {
    if (std::find(known.begin(), known.end(), name) != known.end()) return;
    throw InputError(fmt::format("{} '{}': {} has no such column; {}", what, name, file(), list_choices(name, known)));
  };
  for (const std::string& name : wanted) check(name);
  std::string where;
  for (const Condition& c : conditions) {
    check(c.key);
    where += (where.empty() ? " WHERE " : " AND ") + condition_sql(c);
  }
  Statement rows = database_->prepare("SELECT " + column_list(wanted) + " FROM results" + where + " ORDER BY point");
  for (std::size_t i = 0; i < conditions.size(); ++i) rows.bind(int(i), conditions[i].value);
  return rows;
}

}  // namespace umbsim
