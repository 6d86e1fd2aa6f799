#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "batch/condition.h"

struct sqlite3;
struct sqlite3_stmt;

namespace umbsim {

class Statement;

/// A SQLite file. What goes wrong is a RunError that names the file; a file of another kind an InputError.
class Database {
 public:
  enum class Mode { read, write };
  Database(const std::filesystem::path& file, Mode mode);

  void run(const std::string& sql);
  Statement prepare(const std::string& sql);
  /// The first column of the first row; nothing if there is no row.
  Cell value(const std::string& sql);
  const std::string& file() const { return file_; }
  /// Throws InputError where the file's content is at fault, else RunError. `reading`: nothing was to be written.
  [[noreturn]] void fail(const std::string& doing, bool reading = true) const;

 private:
  struct Close {
    void operator()(sqlite3* handle) const;
  };
  std::string file_;
  std::unique_ptr<sqlite3, Close> handle_;
};

/// A prepared statement. Columns and parameters count from 0.
class Statement {
 public:
  Statement(Database& database, sqlite3_stmt* handle) : database_(&database), handle_(handle) {}

  Statement& bind(int parameter, const Cell& value);
  /// True: there is a row to be read.
  bool step();
  /// Steps to the end and makes it ready for the next use.
  void run();
  void reset();
  Cell cell(int column) const;
  bool is_null(int column) const;
  /// Of a column that holds a floating-point number; the quick way.
  std::optional<double> number(int column) const;
  std::int64_t integer(int column) const;
  std::string text(int column) const;
  int columns() const;

 private:
  struct Finish {
    void operator()(sqlite3_stmt* handle) const;
  };
  Database* database_;
  std::unique_ptr<sqlite3_stmt, Finish> handle_;
};

/// BEGIN IMMEDIATE now; undone at the end of the scope unless committed.
class Transaction {
 public:
  explicit Transaction(Database& database);
  ~Transaction();
  Transaction(const Transaction&) = delete;
  Transaction& operator=(const Transaction&) = delete;
  void commit();

 private:
  Database& database_;
  bool open_ = true;
};

/// A name as SQL writes it: "effects.wheelbase.relative", with the quotes.
std::string quoted_name(const std::string& name);
/// A text as SQL writes it, in single quotes.
std::string quoted_text(const std::string& text);

}  // namespace umbsim
