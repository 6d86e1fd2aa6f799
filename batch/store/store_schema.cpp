#include "batch/store/store_schema.h"

#include <fmt/format.h>

namespace umbsim {
namespace {

constexpr const char* kTables = R"(
CREATE TABLE sweep (key TEXT PRIMARY KEY, value) WITHOUT ROWID;
CREATE TABLE starts (at_utc TEXT, host TEXT, pid INTEGER, shard TEXT, PRIMARY KEY (at_utc, host, pid)) WITHOUT ROWID;
CREATE TABLE runs (
  point INTEGER REFERENCES points, run TEXT, direction TEXT, stage TEXT, x_m REAL, y_m REAL, theta_rad REAL,
  PRIMARY KEY (point, stage, run)) WITHOUT ROWID;
CREATE TABLE warnings (point INTEGER REFERENCES points, number INTEGER, warning TEXT, PRIMARY KEY (point, number))
  WITHOUT ROWID;
)";

std::string provenance_table(const Provenance& provenance) {
  std::string columns, key;
  for (const auto& [name, value] : provenance) {
    columns += fmt::format(", {} TEXT", quoted_name(name));
    key += (key.empty() ? "" : ", ") + quoted_name(name);
  }
  return fmt::format("CREATE TABLE provenance (provenance INTEGER PRIMARY KEY{}, UNIQUE ({}));\n", columns, key);
}

}  // namespace

std::string schema_sql(const StoreLayout& layout, const Provenance& provenance) {
  std::string sql = kTables + provenance_table(provenance);
  sql += "CREATE TABLE points (point INTEGER PRIMARY KEY, replicate INTEGER, point_seed INTEGER, status TEXT, error "
         "TEXT, provenance INTEGER REFERENCES provenance";
  for (const std::string& axis : layout.axes) sql += ", " + quoted_name(axis);
  sql += ");\nCREATE TABLE figures (point INTEGER PRIMARY KEY REFERENCES points";
  for (const std::string& figure : layout.figures) sql += fmt::format(", {} REAL", quoted_name(figure));
  sql += ");\nCREATE VIEW results AS SELECT * FROM points LEFT JOIN figures USING (point);\n";
  for (const auto& [key, value] : {std::pair{"format", std::string("umbsim-sweep/1")}, std::pair{"name", layout.name},
                                   std::pair{"definition", layout.definition}}) {
    sql += fmt::format("INSERT INTO sweep VALUES ('{}', {});\n", key, quoted_text(value));
  }
  sql += fmt::format("INSERT INTO sweep VALUES ('points', {});\n", layout.points);
  return sql + fmt::format("PRAGMA application_id = {}; PRAGMA user_version = {};\n", kStoreApplication, kStoreVersion);
}

std::vector<std::string> column_names(Database& database, const std::string& table) {
  std::vector<std::string> names;
  Statement rows = database.prepare(fmt::format("SELECT name FROM pragma_table_info({})", quoted_text(table)));
  while (rows.step()) names.push_back(rows.text(0));
  return names;
}

std::string column_list(const std::vector<std::string>& names, const std::string& prefix) {
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ", ") + prefix + quoted_name(name);
  return list;
}

}  // namespace umbsim
