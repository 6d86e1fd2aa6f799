#include "batch/condition.h"

#include <gtest/gtest.h>

#include "batch/shard.h"
#include "batch/store/sqlite.h"
#include "core/error.h"

namespace umbsim {
namespace {

std::string message_of(const std::string& condition) {
  try {
    parse_condition(condition, "--where");
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

TEST(Condition, HasKeyOperatorAndValue) {
  const Condition c = parse_condition("course.side_m >= 2.5", "--where");
  EXPECT_EQ(c.key, "course.side_m");
  EXPECT_EQ(c.op, ">=");
  EXPECT_EQ(c.value, Cell(2.5));
  EXPECT_EQ(parse_condition("a=heading", "").value, Cell(std::string("heading")));
  EXPECT_EQ(parse_condition(" a != 3 ", "").value, Cell(std::int64_t(3)));
  EXPECT_EQ(parse_condition("a<-1e-3", "").value, Cell(-1e-3));
}

TEST(Condition, RefusesWhatIsNone) {
  for (const char* text : {"", "course.side_m", "= 3", "a =", "a ! 3"}) {
    EXPECT_NE(message_of(text).find("--where '" + std::string(text) + "'"), std::string::npos) << text;
  }
}

// The same in memory and in SQL, for every operator and every kind of cell.
TEST(Condition, MeansTheSameInSql) {
  const std::vector<Cell> cells{
      {}, std::int64_t(2), 2.0, -1.5, std::int64_t(7), std::string("b"), std::string("7"), std::string("")};
  const std::vector<Cell> values{std::int64_t(2), 2.0, 6.5, std::string("b"), std::string("a")};
  Database database(":memory:", Database::Mode::write);
  database.run("CREATE TABLE t (\"x.y\")");
  int compared = 0;
  for (const Cell& cell : cells) {
    database.run("DELETE FROM t");
    database.prepare("INSERT INTO t VALUES (?)").bind(0, cell).run();
    for (const char* op : {"=", "!=", "<", "<=", ">", ">="}) {
      for (const Cell& value : values) {
        const Condition c{"x.y", op, value};
        Statement rows = database.prepare("SELECT 1 FROM t WHERE " + condition_sql(c));
        EXPECT_EQ(rows.bind(0, value).step(), fulfils(cell, c)) << text_of_cell(cell) << op << text_of_cell(value);
        ++compared;
      }
    }
  }
  EXPECT_EQ(compared, 8 * 6 * 5);
}

TEST(Shard, CountsFromOneAsPeopleDo) {
  const Shard shard = parse_shard("2/4");
  EXPECT_FALSE(shard.has(0));
  EXPECT_TRUE(shard.has(1));
  EXPECT_TRUE(shard.has(5));
  EXPECT_TRUE(parse_shard("1/1").whole());
}

TEST(Shard, RefusesWhatIsNone) {
  for (const char* text : {"", "2", "0/4", "5/4", "1/0", "a/4", "1/4x", "-1/4", "1.5/4", "1/"}) {
    EXPECT_THROW(parse_shard(text), InputError) << text;
  }
}

}  // namespace
}  // namespace umbsim
