#include "batch/store/sqlite.h"

#include <fmt/format.h>
#include <sqlite3.h>

#include <exception>

#include "core/error.h"

namespace umbsim {
namespace {

// How long another process may hold the lock; each holds it for one point.
constexpr int kBusyTimeout_ms = 120000;
constexpr int kRetry_ms = 20;

std::string quoted(const std::string& text, char mark) {
  std::string out(1, mark);
  for (const char c : text) out += c == mark ? std::string(2, mark) : std::string(1, c);
  return out + mark;
}

bool is_damage(int code) { return code == SQLITE_CORRUPT || code == SQLITE_NOTADB; }

// What SQLite may say of a schema and values that are not ours. After a failed write it may mean the machine.
bool is_of_content(int code) { return code == SQLITE_ERROR || code == SQLITE_TOOBIG || code == SQLITE_MISMATCH; }

}  // namespace

void Database::Close::operator()(sqlite3* handle) const { sqlite3_close_v2(handle); }
void Statement::Finish::operator()(sqlite3_stmt* handle) const { sqlite3_finalize(handle); }

Database::Database(const std::filesystem::path& file, Mode mode) : file_(file.string()) {
  const int flags = mode == Mode::read ? SQLITE_OPEN_READWRITE : SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE;
  sqlite3* handle = nullptr;
  int code = sqlite3_open_v2(file_.c_str(), &handle, flags, nullptr);
  handle_.reset(handle);
  if (code != SQLITE_OK) fail("cannot be opened");
  sqlite3_extended_result_codes(handle, 1);
  sqlite3_busy_timeout(handle, kBusyTimeout_ms);
  // Only reading the first page tells whether it is a database.
  code = sqlite3_exec(handle, "SELECT count(*) FROM sqlite_schema", nullptr, nullptr, nullptr);
  if (code == SQLITE_NOTADB) throw InputError(fmt::format("{}: is not an SQLite database", file_));
  if (code != SQLITE_OK) fail("cannot be read");
}

void Database::fail(const std::string& doing, bool reading) const {
  const int code = handle_ ? sqlite3_errcode(handle_.get()) & 0xff : SQLITE_NOMEM;
  if (is_damage(code) || (reading && is_of_content(code))) {
    throw InputError(fmt::format("{}: is damaged or cut off: SQLite says: {}", file_, sqlite3_errmsg(handle_.get())));
  }
  throw RunError(fmt::format("{}: {}: {}", file_, doing, handle_ ? sqlite3_errmsg(handle_.get()) : "out of memory"));
}

// SQLite does not wait by itself where two processes change the journal's mode at once: outside a transaction the whole
// is tried again until the same time is up.
void Database::run(const std::string& sql) {
  int code = sqlite3_exec(handle_.get(), sql.c_str(), nullptr, nullptr, nullptr);
  for (int waited_ms = 0;
       (code & 0xff) == SQLITE_BUSY && sqlite3_get_autocommit(handle_.get()) && waited_ms < kBusyTimeout_ms;
       waited_ms += kRetry_ms) {
    sqlite3_sleep(kRetry_ms);
    code = sqlite3_exec(handle_.get(), sql.c_str(), nullptr, nullptr, nullptr);
  }
  if (code != SQLITE_OK) fail("SQLite failed", false);
}

Statement Database::prepare(const std::string& sql) {
  sqlite3_stmt* statement = nullptr;
  if (sqlite3_prepare_v2(handle_.get(), sql.c_str(), int(sql.size()), &statement, nullptr) != SQLITE_OK) {
    fail("SQLite failed");
  }
  return Statement(*this, statement);
}

Cell Database::value(const std::string& sql) {
  Statement statement = prepare(sql);
  return statement.step() ? statement.cell(0) : Cell{};
}

Statement& Statement::bind(int parameter, const Cell& value) {
  int code = SQLITE_OK;
  if (const auto* integer = std::get_if<std::int64_t>(&value)) {
    code = sqlite3_bind_int64(handle_.get(), parameter + 1, *integer);
  } else if (const auto* number = std::get_if<double>(&value)) {
    code = sqlite3_bind_double(handle_.get(), parameter + 1, *number);
  } else if (const auto* text = std::get_if<std::string>(&value)) {
    code = sqlite3_bind_text(handle_.get(), parameter + 1, text->data(), int(text->size()), SQLITE_TRANSIENT);
  } else {
    code = sqlite3_bind_null(handle_.get(), parameter + 1);
  }
  if (code != SQLITE_OK) database_->fail("SQLite failed");
  return *this;
}

bool Statement::step() {
  const int code = sqlite3_step(handle_.get());
  if (code == SQLITE_ROW) return true;
  if (code != SQLITE_DONE) database_->fail("SQLite failed");
  return false;
}

void Statement::run() {
  while (step()) {
  }
  reset();
}

void Statement::reset() { sqlite3_reset(handle_.get()); }

Cell Statement::cell(int column) const {
  switch (sqlite3_column_type(handle_.get(), column)) {
    case SQLITE_INTEGER: return std::int64_t(sqlite3_column_int64(handle_.get(), column));
    case SQLITE_FLOAT: return sqlite3_column_double(handle_.get(), column);
    case SQLITE_NULL: return {};
    default: return text(column);
  }
}

bool Statement::is_null(int column) const { return sqlite3_column_type(handle_.get(), column) == SQLITE_NULL; }

std::optional<double> Statement::number(int column) const {
  if (sqlite3_column_type(handle_.get(), column) != SQLITE_FLOAT) return std::nullopt;
  return sqlite3_column_double(handle_.get(), column);
}

std::int64_t Statement::integer(int column) const { return sqlite3_column_int64(handle_.get(), column); }

std::string Statement::text(int column) const {
  const auto* text = reinterpret_cast<const char*>(sqlite3_column_text(handle_.get(), column));
  return text ? std::string(text, std::size_t(sqlite3_column_bytes(handle_.get(), column))) : std::string();
}

int Statement::columns() const { return sqlite3_column_count(handle_.get()); }

Transaction::Transaction(Database& database) : database_(database) { database_.run("BEGIN IMMEDIATE"); }

Transaction::~Transaction() {
  if (!open_) return;
  try {
    database_.run("ROLLBACK");
  } catch (const std::exception&) {
    // SQLite has rolled back by itself, on a full disk for instance, or the file is damaged: what led here says so.
  }
}

void Transaction::commit() {
  database_.run("COMMIT");
  open_ = false;
}

std::string quoted_name(const std::string& name) { return quoted(name, '"'); }
std::string quoted_text(const std::string& text) { return quoted(text, '\''); }

}  // namespace umbsim
