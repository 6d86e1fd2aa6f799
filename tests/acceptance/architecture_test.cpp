// The house plan (docs/architecture.md): which folder may include which, who sees Bullet, what stands at the top.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <optional>
#include <regex>
#include <set>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;
using Names = std::set<std::string>;

/// A folder may include itself and these.
const std::map<std::string, Names> kArrows = {
    {"core", {}},
    {"sim", {"core"}},
    {"odometry", {"core"}},
    {"recording", {"core"}},
    {"report", {"core"}},
    {"effects", {"sim", "odometry", "core"}},
    {"umbmark", {"recording", "odometry", "core"}},
    {"calibration", {"umbmark", "recording", "odometry", "core"}},
    {"batch", {"core"}},
    {"gap", {"calibration", "recording", "odometry", "effects", "batch", "core"}},
    {"experiment", {"batch", "effects", "calibration", "umbmark", "recording", "odometry", "sim", "core"}},
    {"exchange", {"calibration", "recording", "odometry", "sim", "core"}},
    {"cli",
     {"exchange", "experiment", "gap", "calibration", "report", "umbmark", "effects", "recording", "odometry", "sim",
      "batch", "core"}},
};
/// Rooms of a folder, in data order: a room may include itself, those before it in its list, and no other. Files that
/// stand in the folder itself, its spine, may include all rooms, and are seen by few.
struct Rooms {
  std::map<std::string, Names> may_include;
  Names see_the_spine;  ///< rooms that format, sweep or explain what the spine returns
};
const std::map<std::string, Rooms> kRooms = {
    {"core", {{{"text", {}}}, {"text"}}},
    {"sim", {{{"model", {}}, {"mesh", {}}, {"urdf", {"model", "mesh"}}, {"dynamics", {"model"}}}, {}}},
    {"gap",
     {{{"traits", {}},
       {"replay", {"traits"}},
       {"noise", {"traits", "replay"}},
       {"hypotheses", {"traits"}},
       {"evidence", {"traits", "replay", "noise", "hypotheses"}},
       {"search", {"traits", "replay", "noise", "hypotheses", "evidence"}},
       {"answer", {"traits", "replay", "noise", "hypotheses", "evidence", "search"}},
       {"plan", {"traits", "replay", "noise", "hypotheses", "evidence", "search", "answer"}},
       {"output", {"traits", "replay", "noise", "hypotheses", "evidence", "search", "answer", "plan"}},
       {"trial", {}}},
      {}}},
    {"gap/trial",
     {{{"draw", {}}, {"write", {"draw"}}, {"diagnose", {"draw", "write"}}, {"score", {"draw", "write", "diagnose"}}},
      {}}},
    {"experiment",
     {{{"scenario", {}},
       {"drive", {"scenario"}},
       {"replay", {"scenario", "drive"}},
       {"robot", {"scenario", "drive"}},
       {"explain", {"scenario", "drive"}},
       {"output", {"scenario", "drive", "explain"}},
       {"sweep", {"scenario", "drive", "output"}}},
      {"explain", "output", "sweep"}}},
    {"batch", {{{"store", {}}}, {"store"}}},
    {"exchange/bag", {{{"files", {}}, {"messages", {}}}, {}}},
    {"exchange/import", {{{"wheels", {}}, {"truth", {}}, {"runs", {}}}, {"wheels", "truth", "runs"}}},
    {"cli",
     {{{"help", {}}, {"output", {}}, {"commands", {"help", "output"}}, {"gap", {"help", "output"}}},
      {"help", "output", "commands", "gap"}}},
    {"bench/worlds",
     {{{"engines", {}},
       {"drivers", {}},
       {"world", {"engines", "drivers"}},
       {"run", {"world"}},
       {"draw", {"world", "run"}},
       {"inject", {}},
       {"checks", {"engines"}},
       {"learn", {}},
       {"score", {}},
       {"commands", {"engines", "world", "run", "draw", "inject", "checks", "learn", "score"}}},
      {}}},
};
/// A room holds few files of its own, sub-rooms not counted.
constexpr int kMostFiles = 20;
constexpr int kMostLines = 2500;
/// Of effects/, gap/ may see the table only.
const Names kGapSeesOfEffects = {"effects/catalogue.h", "effects/words.h"};

/// Where Bullet may be seen.
const Names kSeesBullet = {"sim", "tests/sim", "bench"};

const Names kTopLevel = {
    "README.md", "CHANGELOG.md", "umbsim",      "test",    "CMakeLists.txt",  "CMakePresets.json",
    "scenarios", "robots",       "core",        "sim",     "odometry",        "effects",
    "umbmark",   "recording",    "calibration", "gap",     "experiment",      "report",
    "batch",     "exchange",     "cli",         "tests",   "bench",           "docs",
    "cmake",     "results",      "slurm",       "LICENSE", "CONTRIBUTING.md", "CMakeUserPresets.json"};
const Names kMustStand = {"README.md", "CHANGELOG.md", "umbsim", "test", "CMakeLists.txt", "CMakePresets.json"};

const fs::path kRoot = UMBSIM_SOURCE_DIR;

struct Include {
  std::string file;    ///< relative to the root
  std::string folder;  ///< first part of `file`; the first two below tests/
  int line = 0;
  std::string name;
  bool quoted = false;
};

std::string folder_of(const fs::path& file) {
  auto part = file.begin();
  const std::string first = part->string();
  return first == "tests" && ++part != file.end() ? first + "/" + part->string() : first;
}

bool is_source(const fs::path& file) {
  const std::string extension = file.extension().string();
  return Names{".h", ".cpp", ".hpp", ".cc", ".in"}.count(extension) > 0;
}

void add_includes(const fs::path& file, std::vector<Include>& includes) {
  static const std::regex pattern(R"(^\s*#\s*include\s*([<"])([^>"]+)[>"])");
  std::ifstream stream(kRoot / file);
  std::string text;
  for (int line = 1; std::getline(stream, text); ++line) {
    std::smatch match;
    if (!std::regex_search(text, match, pattern)) continue;
    includes.push_back({file.string(), folder_of(file), line, match[2], match[1] == "\""});
  }
}

const std::vector<Include>& all_includes() {
  static const std::vector<Include> includes = [] {
    std::vector<Include> found;
    Names folders = {"tests", "bench"};
    for (const auto& [folder, below] : kArrows) folders.insert(folder);
    for (const std::string& folder : folders) {
      if (!fs::is_directory(kRoot / folder)) continue;
      for (const auto& entry : fs::recursive_directory_iterator(kRoot / folder)) {
        if (entry.is_regular_file() && is_source(entry.path())) add_includes(fs::relative(entry.path(), kRoot), found);
      }
    }
    return found;
  }();
  return includes;
}

std::vector<std::string> parts_of(const fs::path& path) {
  std::vector<std::string> parts;
  for (const fs::path& part : path) parts.push_back(part.string());
  return parts;
}

std::string where(const Include& i) { return i.file + ":" + std::to_string(i.line) + ": includes " + i.name; }

TEST(Architecture, SourcesAreFound) { EXPECT_GT(all_includes().size(), 100u); }

TEST(Architecture, FoldersIncludeOnlyWhatTheyMay) {
  for (const Include& i : all_includes()) {
    const auto arrows = kArrows.find(i.folder);
    if (!i.quoted || arrows == kArrows.end()) continue;  // tests and benchmarks may see everything
    const std::size_t slash = i.name.find('/');
    if (slash == std::string::npos) continue;  // a generated file of the same folder
    const std::string target = i.name.substr(0, slash);
    EXPECT_TRUE(target == i.folder || arrows->second.count(target)) << where(i);
    if (i.folder == "gap" && target == "effects") EXPECT_TRUE(kGapSeesOfEffects.count(i.name)) << where(i);
  }
}

/// The room that a file stands in, of a folder with rooms: "" if it is of the spine, nothing if it is elsewhere.
std::optional<std::string> room_in(const std::string& folder, const std::string& file) {
  if (file.rfind(folder + "/", 0) != 0) return {};
  const std::string rest = file.substr(folder.size() + 1);
  const std::size_t slash = rest.find('/');
  return slash == std::string::npos ? "" : rest.substr(0, slash);
}

TEST(Architecture, RoomsIncludeOnlyWhatTheyMay) {
  int seen = 0;
  for (const auto& [folder, rooms] : kRooms) {
    for (const Include& i : all_includes()) {
      const auto from = room_in(folder, i.file), to = room_in(folder, i.name);
      if (!from || !to || from->empty() || *from == *to) continue;
      ++seen;
      const auto room = rooms.may_include.find(*from);
      ASSERT_NE(room, rooms.may_include.end()) << i.file << " stands in a room that this test does not know";
      const bool may = to->empty() ? rooms.see_the_spine.count(*from) > 0 : room->second.count(*to) > 0;
      EXPECT_TRUE(may) << where(i);
    }
  }
  EXPECT_GT(seen, 100);
}

TEST(Architecture, RoomsAreSmall) {
  std::map<std::string, std::pair<int, int>> rooms;  // files, lines
  for (const auto& [folder, below] : kArrows) {
    for (const auto& entry : fs::recursive_directory_iterator(kRoot / folder)) {
      if (!entry.is_regular_file() || !is_source(entry.path())) continue;
      std::ifstream stream(entry.path());
      auto& [files, lines] = rooms[fs::relative(entry.path().parent_path(), kRoot).string()];
      ++files;
      lines += int(std::count(std::istreambuf_iterator<char>(stream), {}, '\n'));
    }
  }
  for (const auto& [room, size] : rooms) {
    EXPECT_LE(size.first, kMostFiles) << room;
    EXPECT_LE(size.second, kMostLines) << room;
  }
}

/// Names of all effects, as the catalogue's table begins its lines.
Names effects() {
  std::ifstream stream(kRoot / "effects/table.cpp");
  const std::string text(std::istreambuf_iterator<char>(stream), {});
  static const std::regex line(R"re(line<\w+>\(\s*"([a-z_]+)")re");
  Names names;
  for (auto m = std::sregex_iterator(text.begin(), text.end(), line); m != std::sregex_iterator(); ++m)
    names.insert((*m)[1]);
  return names;
}

// What gap/ knows of an effect stands in its table of traits, and how it is fitted among the hypotheses. Elsewhere an
// effect's name may only fetch its physics from the catalogue, or name what a file is about; the trial draws effects.
TEST(Architecture, GapAsksForTraitsNotForNames) {
  const Names names = effects();
  EXPECT_GT(names.size(), 25u);
  static const std::regex literal(R"re((\w*\W?)"([a-z_]+)")re");
  for (const auto& entry : fs::recursive_directory_iterator(kRoot / "gap")) {
    const std::string file = fs::relative(entry.path(), kRoot).string();
    const std::string room = file.substr(0, file.find('/', 4));
    if (!entry.is_regular_file() || Names{"gap/traits", "gap/hypotheses", "gap/trial"}.count(room)) continue;
    std::ifstream stream(entry.path());
    std::string text;
    for (int line = 1; std::getline(stream, text); ++line) {
      for (auto m = std::sregex_iterator(text.begin(), text.end(), literal); m != std::sregex_iterator(); ++m) {
        const std::string before = (*m)[1];
        const bool fetched = before.ends_with("find_effect(") || text.starts_with("inline constexpr");
        EXPECT_TRUE(fetched || names.count((*m)[2]) == 0) << file << ":" << line << ": " << text;
      }
    }
  }
}

/// Functions that are longer, as docs/architecture.md says why: the file, and what its longest function may have.
constexpr int kLongFile = 300, kLongFunction = 60;
const std::map<std::string, int> kLongFunctions = {
    {"effects/table.cpp", 260},  // tables: one entry an effect, a column, an engine's answer to each effect
    {"effects/words.cpp", 200},
    {"exchange/text/column_meaning.cpp", 80},
    {"bench/worlds/engines/mujoco.cpp", 80},
    {"gap/answer/closure.cpp", 85},
    {"gap/output/diagnosis_json.cpp", 80},
    {"gap/search/screen.cpp", 75},
};

std::vector<std::string> lines_of(const fs::path& file) {
  std::ifstream stream(file);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

/// Lines of the longest function, by the house's format: it ends with the first line that begins with a brace.
int longest_function(const std::vector<std::string>& lines) {
  static const std::regex other(R"(^(namespace|struct|class|enum|extern|union|const\w* .*=|//|#| |\}).*)");
  int longest = 0, begin = -1;
  for (int i = 0; i < int(lines.size()); ++i) {
    const std::string& line = lines[std::size_t(i)];
    if (line.empty()) continue;
    if (begin >= 0 && line[0] == '}') {
      longest = std::max(longest, i - begin + 1);
      begin = -1;
    }
    if (begin < 0 && line.back() == '{' && !std::regex_match(line, other)) begin = i;
  }
  return longest;
}

TEST(Architecture, FilesAndFunctionsAreShort) {
  const auto limit = [](const std::map<std::string, int>& longer, const std::string& file, int usual) {
    const auto found = longer.find(file);
    return found == longer.end() ? usual : found->second;
  };
  int most = 0;
  Names folders = {"bench"};
  for (const auto& [folder, below] : kArrows) folders.insert(folder);
  for (const std::string& folder : folders) {
    for (const auto& entry : fs::recursive_directory_iterator(kRoot / folder)) {
      if (!entry.is_regular_file() || !is_source(entry.path())) continue;
      const std::string file = fs::relative(entry.path(), kRoot).string();
      const std::vector<std::string> lines = lines_of(entry.path());
      const int function = longest_function(lines);
      most = std::max(most, function);
      EXPECT_LE(int(lines.size()), kLongFile) << file;
      EXPECT_LE(function, limit(kLongFunctions, file, kLongFunction)) << "the longest function of " << file;
    }
  }
  EXPECT_GT(most, kLongFunction) << "functions are not found";
}

TEST(Architecture, TheDrawingShowsTheIncludes) {
  if (std::system("python3 --version > /dev/null 2>&1") != 0) GTEST_SKIP() << "no python3";
  const std::string script = (kRoot / "docs/make-architecture.py").string();
  EXPECT_EQ(std::system(("python3 '" + script + "' --check").c_str()), 0);
}

/// A file that a page names, and the function that it is named for: "`measure()` (`experiment/measure.cpp`)".
struct Station {
  std::string function;
  std::string file;
  int line = 0;
};

std::vector<Station> stations(const std::string& page, const std::string& from, const std::string& to) {
  std::ifstream stream(kRoot / page);
  static const std::regex pattern(R"((?:`([A-Za-z_:]+)\(\)`,? \()?`([a-z_]+(?:/[a-z_]+)*/[a-z_]+\.(?:cpp|h))`)");
  std::vector<Station> found;
  bool open = from.empty();
  std::string text;
  for (int line = 1; std::getline(stream, text); ++line) {
    if (!from.empty() && text == from) open = true;
    if (!to.empty() && text == to) open = false;
    if (!open) continue;
    for (auto m = std::sregex_iterator(text.begin(), text.end(), pattern); m != std::sregex_iterator(); ++m)
      found.push_back({(*m)[1], (*m)[2], line});
  }
  return found;
}

bool holds(const fs::path& file, const std::string& word) {
  std::ifstream stream(file);
  return std::string(std::istreambuf_iterator<char>(stream), {}).find(word) != std::string::npos;
}

// Both walks of docs/life-of-a-run.md: every file is there, once, holds the function that it is named for, and in a
// folder with rooms the walk never goes back to a room that lies before.
TEST(Architecture, WalksGoForward) {
  const std::string page = "docs/life-of-a-run.md", second = "## From a recording to a twin";
  for (const auto& walk : {stations(page, "", second), stations(page, second, "")}) {
    EXPECT_GT(walk.size(), 8u);
    Names seen;
    std::map<std::string, std::string> room_of;
    for (const Station& s : walk) {
      SCOPED_TRACE(page + ":" + std::to_string(s.line) + ": " + s.file);
      ASSERT_TRUE(fs::exists(kRoot / s.file));
      EXPECT_TRUE(seen.insert(s.file).second) << "a second time";
      const std::size_t scope = s.function.rfind(':');
      if (!s.function.empty())
        EXPECT_TRUE(holds(kRoot / s.file, s.function.substr(scope == std::string::npos ? 0 : scope + 1) + "("))
            << s.function;
      for (const std::string folder : {"experiment", "gap"}) {
        const Rooms& rooms = kRooms.at(folder);
        const auto room = room_in(folder, s.file);
        if (!room || room->empty()) continue;
        std::string& last = room_of[folder];
        if (!last.empty() && last != *room) {
          EXPECT_EQ(rooms.may_include.at(last).count(*room), 0u) << "back from " << last;
        }
        last = *room;
      }
    }
  }
}

TEST(Architecture, NoFileReachesUpwards) {
  for (const Include& i : all_includes()) EXPECT_EQ(i.name.find(".."), std::string::npos) << where(i);
}

TEST(Architecture, OnlySimSeesBullet) {
  const std::regex bullet("(^|/)(bullet|Bullet|bt[A-Z]|LinearMath)");
  int seen = 0;
  for (const Include& i : all_includes()) {
    if (!std::regex_search(i.name, bullet)) continue;
    EXPECT_TRUE(kSeesBullet.count(i.folder)) << where(i);
    ++seen;
  }
  EXPECT_GT(seen, 0);
}

// A header of sim/ that shows Bullet would show it to all who include that header.
TEST(Architecture, OutsideSimNobodyIncludesAHeaderThatShowsBullet) {
  std::map<std::string, Names> includes_of;
  for (const Include& i : all_includes()) includes_of[i.file].insert(i.name);
  const std::regex bullet("(^|/)(bullet|Bullet|bt[A-Z]|LinearMath)");
  for (const auto& [file, direct] : includes_of) {
    if (kSeesBullet.count(folder_of(file))) continue;
    std::vector<std::string> open(direct.begin(), direct.end());
    Names reached;
    while (!open.empty()) {
      const std::string name = open.back();
      open.pop_back();
      if (!reached.insert(name).second) continue;
      EXPECT_FALSE(std::regex_search(name, bullet)) << file << " reaches " << name;
      const auto next = includes_of.find(name);
      if (next != includes_of.end()) open.insert(open.end(), next->second.begin(), next->second.end());
    }
  }
}

/// First parts of the paths of all files that are under version control; empty outside a checkout.
Names tracked_at_the_top() {
  Names names;
  const std::string command = "git -C '" + kRoot.string() + "' ls-files 2>/dev/null";
  std::FILE* pipe = popen(command.c_str(), "r");
  if (!pipe) return names;
  char line[4096];
  while (std::fgets(line, sizeof line, pipe)) {
    const std::string path(line, std::strcspn(line, "\n"));
    names.insert(path.substr(0, path.find('/')));
  }
  pclose(pipe);
  return names;
}

TEST(Architecture, TopLevelIsTheHousePlan) {
  for (const std::string& name : kMustStand) EXPECT_TRUE(fs::exists(kRoot / name)) << name << " is missing";
  const Names tracked = tracked_at_the_top();
  if (tracked.empty()) GTEST_SKIP() << "not a checkout";
  for (const std::string& name : tracked) {
    EXPECT_TRUE(name.front() == '.' || kTopLevel.count(name)) << name << " has no place at the top";
  }
}

TEST(Architecture, DataFoldersHoldDataOnly) {
  for (const auto& [folder, extension] : {std::pair{"scenarios", ".yaml"}, std::pair{"robots", ".urdf"}}) {
    for (const auto& entry : fs::recursive_directory_iterator(kRoot / folder)) {
      if (entry.is_directory()) continue;
      EXPECT_EQ(entry.path().extension(), extension) << entry.path();
    }
  }
}

}  // namespace
