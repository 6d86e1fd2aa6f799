// Logs with something wrong: each is named, nothing is written. The bags in data/spoiled are make_data.py's.
#include <cmath>
#include <functional>

#include "tests/exchange/data_folder.h"

namespace umbsim::acceptance {
namespace {

using Change = std::function<std::string(const std::string&)>;

struct Spoiled {
  const char* name;
  Words words;  ///< behind `import`; "a.csv" and "b.tum" are ticks.csv and truth.tum as changed
  Words says;
  Change counts = nullptr;  ///< of ticks.csv
  Change poses = nullptr;   ///< of truth.tum
};

/// A change of every row's cells.
Change each_row(char delimiter, const std::function<void(std::vector<std::string>&, std::size_t)>& change) {
  return [=](const std::string& text) {
    std::istringstream lines(text);
    std::string out;
    std::size_t row = 0;
    for (std::string line; std::getline(lines, line);) {
      std::vector<std::string> cells;
      std::istringstream parts(line);
      for (std::string cell; std::getline(parts, cell, delimiter);) cells.push_back(cell);
      if (std::isdigit(static_cast<unsigned char>(line[0]))) change(cells, row++);
      for (std::size_t i = 0; i < cells.size(); ++i) out += (i ? std::string(1, delimiter) : "") + cells[i];
      out += "\n";
    }
    return out;
  };
}

Change replaced(const std::string& from, const std::string& to) {
  return [=](std::string text) { return text.replace(text.find(from), from.size(), to); };
}

Change scaled(std::size_t from, std::size_t to, double by) {
  return each_row(' ', [=](std::vector<std::string>& c, std::size_t) {
    for (std::size_t i = from; i <= to; ++i) c[i] = std::to_string(by * std::stod(c[i]));
  });
}

Words text_files(const Words& more = {}) { return joined(joined({"a.csv", "--truth-file", "b.tum"}, kTicks), more); }
Words bag(const std::string& name, const Words& more = {}) { return joined({data("spoiled/" + name + ".mcap")}, more); }

const std::vector<Spoiled>& spoiled_texts() {
  static const std::vector<Spoiled> all = {
      {"a text for a number",
       text_files(),
       {"a.csv:", "left_ticks", "'oops' is not a number"},
       each_row(',',
                [](auto& c, std::size_t i) {
                  if (i == 400) c[1] = "oops";
                })},
      {"NaN in the counts",
       text_files(),
       {"left_ticks", "not a finite number"},
       each_row(',',
                [](auto& c, std::size_t i) {
                  if (i == 400) c[1] = "nan";
                })},
      {"NaN in the truth",
       text_files(),
       {"b.tum", "not a finite number"},
       nullptr,
       each_row(' ',
                [](auto& c, std::size_t i) {
                  if (i == 300) c[1] = "nan";
                })},
      {"times that run back",
       text_files(),
       {"a.csv:402", "times must increase"},
       each_row(',',
                [](auto& c, std::size_t i) {
                  if (i == 400) c[0] = "1700000000.5";
                })},
      {"stamps of the truth that run back",
       text_files(),
       {"b.tum: pose 301", "stamps must increase"},
       nullptr,
       each_row(' ',
                [](auto& c, std::size_t i) {
                  if (i == 300) c[0] = "1700000000.5";
                })},
      {"a row that is cut off",
       text_files(),
       {"a.csv:", "cells"},
       [](const std::string& t) { return t + "1700000101,5\n"; }},
      {"an empty file", text_files(), {"a.csv", "holds no rows"}, [](const std::string&) { return std::string(); }},
      {"a header alone",
       text_files(),
       {"a.csv", "holds no rows"},
       [](const std::string&) { return std::string("time_s,left_ticks,right_ticks\n"); }},
      {"points and commas mixed",
       text_files(),
       {"decimal points and decimal commas"},
       [](const std::string&) {
         return std::string("time_s;left_ticks;right_ticks\n0,1;1.5;2\n0,2;1.5;2\n0,3;2;2\n");
       }},
      {"no column of a right wheel",
       text_files(),
       {"--right-column", "there are: time_s, left_ticks, other"},
       replaced("right_ticks", "other")},
      {"two columns of a left wheel",
       text_files(),
       {"several columns", "--left-column"},
       replaced("right_ticks", "left_angle_rad")},
      {"a column without a unit",
       text_files(),
       {"unit of column 'left'", "--unit", "rad/s"},
       [](std::string t) { return t.replace(0, t.find('\n'), "time_s,left,right"); }},
      {"no column of time", text_files(), {"--time-column"}, replaced("time_s", "number")},
      {"a time of no clear unit",
       joined({"a.csv", "--truth-file", "b.tum"}, kTicks),
       {"--time-unit"},
       [](const std::string& t) {
         int row = 0;
         return each_row(
             ',', [&](auto& c, std::size_t) { c[0] = std::to_string(row++); })(std::string(t).replace(0, 6, "time"));
       }},
      {"a column that is not there",
       text_files({"--left-column", "wheel"}),
       {"--left-column wheel", "no column has this name"}},
      {"one column for both wheels",
       text_files({"--left-column", "left_ticks", "--right-column", "left_ticks"}),
       {"cannot be both wheels'"}},
      {"swapped wheels",
       text_files({"--left-column", "right_ticks", "--right-column", "left_ticks"}),
       {"swapped", "exchange --left-joint"}},
      {"counts ten times too many",
       text_files(),
       {"wrong by 10", "--ticks-per-revolution"},
       each_row(',', [](auto& c, std::size_t) { c[1] += "0", c[2] += "0"; })},
      {"degrees for radians", {"a.csv", "--truth-file", "b.tum", "--unit", "rad"}, {"truth's way is"}},
      {"a wheel that does not count",
       text_files(),
       {"left wheel hardly counts"},
       each_row(',', [](auto& c, std::size_t) { c[1] = "0"; })},
      {"a counter that jumps",
       text_files(),
       {"left ticks jump"},
       each_row(',',
                [](auto& c, std::size_t i) {
                  if (i > 300) c[1] = std::to_string(std::stol(c[1]) + 9000);
                })},
      {"a counter that overflows",
       text_files(),
       {"right ticks jump", "overflowed"},
       each_row(',',
                [](auto& c, std::size_t i) {
                  if (i > 700) c[2] = std::to_string(std::stol(c[2]) - 65536);
                })},
      {"a truth in millimetres", text_files(), {"millimetres"}, nullptr, scaled(1, 2, 1000)},
      {"a truth that is mirrored", text_files(), {"mirrored"}, nullptr, scaled(2, 2, -1)},
      {"a truth that stands still",
       text_files(),
       {"no motion in the truth"},
       nullptr,
       each_row(' ', [](auto& c, std::size_t) { c[1] = c[2] = c[6] = "0", c[7] = "1"; })},
      {"a truth with a gap",
       text_files(),
       {"gap"},
       nullptr,
       each_row(' ',
                [](auto& c, std::size_t i) {
                  if (i > 150 && i < 260) c.assign({"#"});
                })},
      {"a truth of another day",
       text_files(),
       {"do not overlap", "--truth-offset"},
       nullptr,
       each_row(' ', [](auto& c, std::size_t) { c[0].replace(0, 4, "1600"); })},
      {"a truth without wheels", {data("truth.tum")}, {"holds a trajectory, no wheels", "--truth-file"}},
      {"wheels without a truth", joined({data("ticks.csv")}, kTicks), {"holds no truth", "--truth-file"}},
      {"KITTI without times",
       joined({data("ticks.csv"), "--truth-file", data("truth.kitti")}, kTicks),
       {"--times", "--truth-rate"}},
      {"ticks per revolution not said",
       {data("ticks.csv"), "--truth-file", data("truth.tum")},
       {"--ticks-per-revolution"}},
      {"a runs file that runs back", text_files({"--runs", "runs.csv"}), {"runs.csv:3", "from_s", "the end of a"}},
      {"a runs file beyond the log", text_files({"--runs", "late.csv"}), {"run a", "no rows of both wheels and truth"}},
      {"no squares",
       text_files({"--cut", "squares"}),
       {"no square was found", "--runs"},
       [](const std::string& t) { return t.substr(0, t.rfind('\n', 12000) + 1); }},
      {"a file that is not there", {"nowhere.csv"}, {"nowhere.csv", "no such file"}},
  };
  return all;
}

const std::vector<Spoiled>& spoiled_bags() {
  static const std::vector<Spoiled> all = {
      {"NaN in a message", bag("nan_position"), {"/joint_states", "wheel_left_joint", "not a finite number"}},
      {"NaN in a pose", bag("nan_pose"), {"/mocap/pose: pose 101", "position is not finite"}},
      {"a quaternion of zeros", bag("zero_quaternion"), {"pose 101", "quaternion has length 0"}},
      {"stamps that run back", bag("stamps_back"), {"/joint_states: message 151", "stamps must increase"}},
      {"two names, one position", bag("one_position"), {"message 151", "2 names, but 1 positions"}},
      {"a pose beside the track", bag("outlier"), {"beside the track"}},
      {"joints swapped", bag("swapped"), {"swapped", "exchange --left-joint"}},
      {"an arm's joints", bag("arm_only"), {"--left-joint", "shoulder"}},
      {"no wheels", bag("no_wheels"), {"no topic holds wheels", "/mocap/pose"}},
      {"no truth", bag("no_truth"), {"no topic holds a truth", "--truth"}},
      {"degrees for radians", bag("positions_in_degrees"), {"degrees, not radians"}},
      {"positions by ten", bag("positions_by_ten"), {"wrong by 10"}},
      {"millimetres for metres", bag("truth_in_millimetres"), {"millimetres"}},
      {"a truth by ten", bag("truth_by_ten"), {"wrong by 10"}},
      {"a heading that grows clockwise", bag("heading_reversed"), {"mirrored", "clockwise"}},
      {"messages in JSON", bag("json"), {"written as 'json'"}},
      {"bytes of another type", bag("not_that_type"), {"/joint_states: message 1", "is no sensor_msgs/JointState"}},
      {"a type without positions", bag("no_position_field"), {"no field 'position'"}},
      {"a type that is not defined", bag("undefined_type"), {"does not define type my_msgs/Wheel"}},
      {"two robots", bag("two_robots"), {"two robots in one bag?", "/b/joint_states", "--encoders"}},
      {"two truths", bag("two_truths"), {"several topics may be the truth", "/b/pose", "--truth"}},
      {"four wheels", bag("four_wheels"), {"several joints may be the left wheel's", "--left-joint"}},
      {"two senders on one topic", bag("interleaved"), {"stamps must increase", "two senders"}},
      {"an hour's time zone", bag("other_clock"), {"do not overlap", "give --truth-offset -3600.0"}},
      {"a frame that looks aside", bag("looks_aside"), {"does not look ahead", "90.0 degrees", "--mount"}},
      {"y that points up", bag("y_up"), {"--up"}},
      {"a robot that lies on its side", bag("lying"), {"tilted by 90 degrees", "--up"}},
      {"transforms of two robots", bag("tf_of_two"), {"--truth tf:PARENT/CHILD", "a/odom/a/base_link"}},
      {"a frame with two parents", bag("two_parents"), {"has two parents"}},
      {"a topic that is not there", bag("good", {"--encoders", "/wheels"}), {"--encoders /wheels", "no such topic"}},
      {"a topic of another type", bag("good", {"--encoders", "/mocap/pose"}), {"holds no wheels"}},
      {"a truth of another type", bag("good", {"--truth", "/joint_states"}), {"holds no poses"}},
      {"a joint that is not there", bag("good", {"--left-joint", "hip"}), {"no joint 'hip'", "wheel_left_joint"}},
      {"a transform that is not there",
       {data("drive_tf.mcap"), "--truth", "tf:world/arm"},
       {"'arm'", "world/base_link"}},
      {"a folder without a bag", {"."}, {"folder without a bag"}}};
  return all;
}

void expect_refused(const Desk& desk, const Spoiled& s) {
  SCOPED_TRACE(s.name);
  const auto before = listing(desk.home);
  const Outcome outcome = desk.umbsim(joined(joined({"import"}, s.words), joined(kRobot, {"--out", "out"})));
  EXPECT_EQ(outcome.code, 2) << outcome.out << outcome.err;
  EXPECT_EQ(outcome.out, "");
  expect_says(outcome.err, s.says);
  EXPECT_EQ(listing(desk.home), before);
}

TEST(Spoiled, TextsAreNamedAndNothingIsWritten) {
  const std::string counts = text_of(data("ticks.csv")), poses = text_of(data("truth.tum"));
  for (const Spoiled& s : spoiled_texts()) {
    const Desk desk;
    desk.put("a.csv", s.counts ? s.counts(counts) : counts);
    desk.put("b.tum", s.poses ? s.poses(poses) : poses);
    desk.put("runs.csv", "id,from_s,to_s\na,3,30\nb,20,40\n");
    desk.put("late.csv", "id,from_s,to_s\na,300,400\n");
    expect_refused(desk, s);
  }
}

TEST(Spoiled, BagsAreNamedAndNothingIsWritten) {
  for (const Spoiled& s : spoiled_bags()) {
    const Desk desk;
    expect_refused(desk, s);
  }
}

TEST(Spoiled, ThereAreManyWays) { EXPECT_GE(spoiled_texts().size() + spoiled_bags().size(), 60u); }

// Cut at many places, each kind of bag is refused, never read in part.
TEST(Spoiled, BagsThatAreCutOffAreNamed) {
  for (const char* name : {"drive_zstd.mcap", "drive_lz4.mcap", "drive_db3/drive_0.db3", "drive.bag"}) {
    const std::string whole = text_of(data(name));
    for (const double share : {0.0, 0.0001, 0.1, 0.5, 0.9, 0.9999}) {
      SCOPED_TRACE(std::string(name) + " " + std::to_string(share));
      const Desk desk;
      const std::string file = "cut" + fs::path(name).extension().string();
      desk.put(file, whole.substr(0, std::size_t(share * double(whole.size()))));
      expect_refused(desk, {name, {file}, {file}});
    }
  }
}

TEST(Spoiled, ABagThatWasNotClosedIsNamed) {
  const Desk desk;
  desk.put("bag.db3", text_of(data("drive_db3/drive_0.db3")));
  desk.put("bag.db3-wal", "pages");
  expect_refused(desk, {"write-ahead log", {"bag.db3"}, {"bag.db3: was not closed", "wal_checkpoint"}});
}

// A bit that flips in a chunk is found by its checksum, or by the packing.
TEST(Spoiled, DamagedChunksAreNamed) {
  for (const char* name : {"drive_zstd.mcap", "drive_lz4.mcap"}) {
    for (const double place : {0.05, 0.4, 0.8}) {
      std::string bytes = text_of(data(name));
      bytes[std::size_t(place * double(bytes.size()))] ^= 0x10;
      const Desk desk;
      desk.put("flipped.mcap", bytes);
      expect_refused(desk, {name, {"flipped.mcap"}, {"flipped.mcap", "damaged"}});
    }
  }
}

TEST(Spoiled, GoodOnesAreTaken) {
  const Desk desk;
  EXPECT_EQ(desk.umbsim(joined({"import", data("spoiled/good.mcap"), "--out", "out"}, kRobot)).code, 0);
}

}  // namespace
}  // namespace umbsim::acceptance
