#include "batch/store/store.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "batch/store/store_export.h"
#include "core/error.h"

namespace umbsim {
namespace {

namespace fs = std::filesystem;

const StoreLayout kLayout{"demo", "definition 1", 6, {"course.side_m", "calibration.method"}, {"a.x_m", "a.y"}};
const Provenance kProvenance{{"version", "1.0"}, {"commit", "abc"}};

StoredPoint point(std::int64_t number) {
  StoredPoint p;
  p.number = number;
  p.seed = 7;
  p.axes = {0.1 * double(number), std::string(number % 2 ? "heading" : "end, \"point\"")};
  p.figures = {1.0 / double(number + 1), {}};
  p.runs = {{"cw-1", "cw", "before", 1, 2, 3}};
  return p;
}

class StoreTest : public testing::Test {
 protected:
  StoreTest() : folder_(testing::TempDir() + "umbsim_store_" + std::to_string(getpid())) {
    fs::create_directories(folder_);
  }
  ~StoreTest() override { fs::remove_all(folder_); }
  fs::path file(const char* name = "a.sqlite") const { return fs::path(folder_) / name; }
  Store open(const char* name = "a.sqlite", const StoreLayout& layout = kLayout) const {
    return Store::open_for(file(name), layout, kProvenance, Store::Journal::wal);
  }
  std::string exported(Store& store, ExportChoice choice) const {
    choice.file = file("out");
    export_store(store, choice);
    std::ostringstream text;
    text << std::ifstream(choice.file).rdbuf();
    return text.str();
  }
  std::string folder_;
};

TEST_F(StoreTest, KnowsTheProgramsThatOpenedIt) {
  EXPECT_FALSE(open().knows_program()) << "it is new";
  EXPECT_TRUE(open().knows_program());
  const Provenance newer{{"version", "1.1"}, {"commit", "def"}};
  EXPECT_FALSE(Store::open_for(file(), kLayout, newer, Store::Journal::wal).knows_program());
  EXPECT_TRUE(Store::open_for(file(), kLayout, newer, Store::Journal::wal).knows_program());
  EXPECT_TRUE(open().knows_program());
}

TEST_F(StoreTest, KeepsWarningsAndMergesThem) {
  Store a = open("a.sqlite");
  StoredPoint warned = point(2);
  warned.warnings = {"a wheel flew", "it's far off"};
  a.put(warned);
  a.put(point(3));
  Store b = open("b.sqlite");
  b.put(point(1));
  b.take_over(file("a.sqlite"));
  const std::vector<std::pair<std::int64_t, std::string>> both{{2, "a wheel flew"}, {2, "it's far off"}};
  EXPECT_EQ(a.warnings(), both);
  EXPECT_EQ(b.warnings(), both);
}

TEST_F(StoreTest, KnowsWhatIsMissing) {
  Store store = open();
  for (const std::int64_t number : {1, 4}) store.put(point(number));
  EXPECT_TRUE(store.has(1));
  EXPECT_FALSE(store.has(2));
  EXPECT_EQ(store.missing({}), (std::vector<std::int64_t>{0, 2, 3, 5}));
  EXPECT_EQ(store.missing({1, 3}), (std::vector<std::int64_t>{})) << "1 and 4 are the second third";
  EXPECT_EQ(store.missing({0, 3}), (std::vector<std::int64_t>{0, 3}));
}

TEST_F(StoreTest, KeepsTheFirstOfTwoPointsOfOneNumber) {
  Store store = open();
  store.put(point(1));
  StoredPoint other = point(1);
  other.figures[0] = 99.0;
  store.put(other);
  EXPECT_EQ(exported(store, {false, {"point", "a.x_m"}, {}, {}}), "point,a.x_m\n1,0.5\n");
}

TEST_F(StoreTest, RefusesAStoreOfSomethingElse) {
  { Store store = open(); }
  StoreLayout other = kLayout;
  other.definition = "definition 2";
  EXPECT_THROW(open("a.sqlite", other), InputError);
  other = kLayout;
  other.figures.push_back("a.z");
  EXPECT_THROW(open("a.sqlite", other), InputError);
}

TEST_F(StoreTest, RefusesWhatIsNoStore) {
  std::ofstream(file("text")) << "not a database, but long enough to be taken for one at first sight";
  EXPECT_THROW(Store::open(file("text")), InputError);
  EXPECT_THROW(Store::open(file("nothing")), InputError);
  { Database other(file("other"), Database::Mode::write); other.run("CREATE TABLE t (x)"); }
  EXPECT_THROW(Store::open(file("other")), InputError);
}

TEST_F(StoreTest, ExportsCsv) {
  Store store = open();
  store.put(point(1));
  store.put(point(0));
  EXPECT_EQ(exported(store, {}),
            "point,replicate,point_seed,status,provenance,course.side_m,calibration.method,a.x_m\n"
            "0,0,7,done,1,0,\"end, \"\"point\"\"\",1\n1,0,7,done,1,0.1,heading,0.5\n")
      << "in the order of the points, without columns that hold nothing";
}

TEST_F(StoreTest, ExportsJson) {
  Store store = open();
  store.put(point(0));
  store.put(point(2));
  const auto json =
      nlohmann::json::parse(exported(store, {true, {"point", "calibration.method", "a.x_m", "a.y"}, {}, {}}));
  EXPECT_EQ(json.at("columns"), (nlohmann::json{"point", "calibration.method", "a.x_m", "a.y"}));
  EXPECT_EQ(json.at("rows")[1], (nlohmann::json{2, "end, \"point\"", 1.0 / 3, nullptr})) << "to the last bit";
}

TEST_F(StoreTest, ExportsWhatFulfilsAllConditions) {
  Store store = open();
  for (std::int64_t i = 0; i < 6; ++i) store.put(point(i));
  const std::vector<Condition> where{parse_condition("course.side_m > 0.25", ""),
                                     parse_condition("calibration.method = heading", "")};
  EXPECT_EQ(exported(store, {false, {"point"}, where, {}}), "point\n3\n5\n");
  EXPECT_THROW(exported(store, {false, {"points"}, {}, {}}), InputError);
}

TEST_F(StoreTest, MergedStoresAreAsOne) {
  Store whole = open("whole"), odd = open("odd"), even = open("even"), merged = open("merged");
  for (std::int64_t i = 0; i < 6; ++i) {
    whole.put(point(i));
    (i % 2 ? odd : even).put(point(i));
  }
  merged.take_over(file("odd"));
  merged.take_over(file("even"));
  merged.take_over(file("odd"));
  EXPECT_EQ(exported(merged, {}), exported(whole, {}));
  StoreLayout other = kLayout;
  other.definition = "definition 2";
  { Store stranger = open("stranger", other); }
  EXPECT_THROW(merged.take_over(file("stranger")), InputError);
}

// Two programs that shared a sweep end at nearly the same time: neither waits for the other's page.
TEST_F(StoreTest, SettlingDoesNotWaitForWhoElseHasItOpen) {
  const auto begun = std::chrono::steady_clock::now();
  {
    Store a = open(), b = open();
    a.put(point(1));
    a.settle();
    EXPECT_TRUE(b.has(1));
  }
  // Waiting lasts two minutes.
  EXPECT_LT(std::chrono::steady_clock::now() - begun, std::chrono::seconds(60));
  EXPECT_FALSE(fs::exists(file("a.sqlite-wal"))) << "the last one that closes it takes the journal along";
}

TEST_F(StoreTest, FailedPointsCanBeForgotten) {
  Store store = open();
  StoredPoint bad = point(2);
  bad.error = "the state became non-finite";
  bad.figures.clear();
  bad.runs.clear();
  store.put(bad);
  EXPECT_EQ(store.count("failed"), 1);
  store.forget_failed();
  EXPECT_FALSE(store.has(2));
}

}  // namespace
}  // namespace umbsim
