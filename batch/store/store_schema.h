#pragma once

#include "batch/store/store.h"

namespace umbsim {

/// Marks the file as a store of this program: PRAGMA application_id, "umbs".
constexpr std::int64_t kStoreApplication = 0x756d6273;
/// PRAGMA user_version: goes up when the tables change.
constexpr std::int64_t kStoreVersion = 1;

/// All tables and the view `results`; see docs/sweep-database.md.
std::string schema_sql(const StoreLayout& layout, const Provenance& provenance);

/// The names of a table's columns.
std::vector<std::string> column_names(Database& database, const std::string& table);

/// "a", "b", "c": quoted, with `prefix` before each.
std::string column_list(const std::vector<std::string>& names, const std::string& prefix = "");

}  // namespace umbsim
