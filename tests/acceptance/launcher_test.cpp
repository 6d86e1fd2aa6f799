// ./umbsim as a launcher: the real script on a project that builds in no time.
#include "tests/acceptance/program.h"

namespace umbsim::acceptance {
namespace {

constexpr int kFailed = 3;

/// A project whose program is a shell script, with the project's own launcher, set-up and commit. Every call of ninja,
/// dpkg-query and apt-get is noted in `calls`; apt-get "installs" into the packages' list that dpkg-query reads here.
class Launcher : public testing::Test {
 protected:
  void SetUp() override {
    if (desk_.shell("command -v dpkg-query cmake ninja git script").code != 0) GTEST_SKIP() << "needs Debian's tools";
    lay_out_project();
    lay_out_tools();
    ASSERT_EQ(in_project("git init -q . && git add -A && " + kCommit + "one").code, 0);
    const Outcome first = launch();
    ASSERT_EQ(first.code, 0) << first.err;
    expect_says(first.out, {"says hello"});
    forget_calls();
  }

  void lay_out_project() {
    const fs::path source = UMBSIM_SOURCE_DIR;
    fs::create_directories(project_);
    for (const char* name : {"umbsim", "CMakePresets.json"}) fs::copy(source / name, project_ / name);
    fs::create_directory(project_ / "cmake");
    for (const char* name : {"cmake/setup.sh", "cmake/WriteCommit.cmake"}) fs::copy(source / name, project_ / name);
    put_fetch("true");
    put(".gitignore", "/build/\n");
    put("README.md", "read me\n");
    put("CMakeLists.txt",
        "cmake_minimum_required(VERSION 3.25)\nproject(tiny LANGUAGES NONE)\nadd_subdirectory(core)\n");
    put("core/CMakeLists.txt", R"(set(commit ${CMAKE_CURRENT_BINARY_DIR}/commit.h)
set(program ${PROJECT_BINARY_DIR}/umbsim)
add_custom_target(commit COMMAND ${CMAKE_COMMAND} -DSOURCE_DIR=${PROJECT_SOURCE_DIR} -DOUTPUT=${commit}
  -P ${PROJECT_SOURCE_DIR}/cmake/WriteCommit.cmake BYPRODUCTS ${commit})
add_custom_command(OUTPUT ${program} DEPENDS main.sh ${commit} COMMENT "Building tiny"
  COMMAND sh ${CMAKE_CURRENT_SOURCE_DIR}/main.sh check
  COMMAND sh -c "cat $0 $1 > $2 && chmod +x $2" ${CMAKE_CURRENT_SOURCE_DIR}/main.sh ${commit} ${program} VERBATIM)
add_custom_target(umbsim_program DEPENDS ${program})
)");
    put_main("hello", "true");
  }

  void lay_out_tools() {
    for (const std::string tool : {"ninja", "dpkg-query", "cmake"}) {
      const std::string real = desk_.shell("command -v " + tool).out;
      put_tool(tool, "exec " + real.substr(0, real.find('\n')) + " \"$@\"\n");
    }
    put_tool("apt-get", R"(test "$1" = install || exit 0
for package in "$@"; do
  case "$package" in
    install | -*) ;;
    *) printf 'Package: %s\nStatus: install ok installed\nVersion: 1\nArchitecture: all\n\n' "$package" >> "$DPKG_ADMINDIR/status" ;;
  esac
done
)");
    put_tool("sudo", "exec \"$@\"\n");
    install({});
  }

  void put(const std::string& name, const std::string& text) const { desk_.put("project/" + name, text); }
  void put_main(const std::string& word, const std::string& check) const {
    put("core/main.sh", "#!/bin/sh\nif [ \"$1\" = check ]; then " + check + "; exit; fi\necho says " + word +
                            " \"$@\"\ntail -n 1 \"$0\"\nexit 0\n");
  }
  /// What the packages of the pages come by.
  void put_fetch(const std::string& command) const {
    put("report/web/fetch.sh", "#!/bin/sh\n" + command + "\n");
    fs::permissions(project_ / "report/web/fetch.sh", fs::perms::owner_all);
  }
  std::string cached(const std::string& option) const {
    return in_project("grep -o '" + option + ":[A-Z]*=.*' build/release/CMakeCache.txt | sed 's/.*=//'").out;
  }
  void put_tool(const std::string& name, const std::string& text) const {
    desk_.put("bin/" + name,
              "#!/bin/sh\necho " + name + " \"$@\" >> '" + (desk_.home / "calls").string() + "'\n" + text);
    fs::permissions(desk_.home / "bin" / name, fs::perms::owner_all);
  }

  /// All packages of the set-up but `without` are installed.
  void install(const std::string& without) const {
    const std::string names = in_project("source cmake/setup.sh; echo $build_packages").out;
    std::istringstream words(names);
    std::string status;
    for (std::string package; words >> package;) {
      if (package == without) continue;
      status += "Package: " + package + "\nStatus: install ok installed\nVersion: 1\nArchitecture: all\n\n";
    }
    fs::create_directories(desk_.home / "dpkg/updates");
    desk_.put("dpkg/status.new", status);
    fs::rename(desk_.home / "dpkg/status.new", desk_.home / "dpkg/status");
  }

  Outcome in_project(const std::string& line) const {
    const std::string setting = "export DPKG_ADMINDIR=" + shell_quoted((desk_.home / "dpkg").string()) +
                                " PATH=" + shell_quoted((desk_.home / "bin").string()) + ":$PATH; ";
    return desk_.shell(setting + "cd project && bash -c " + shell_quoted(line));
  }
  Outcome launch() const { return in_project("./umbsim"); }
  std::string calls() const { return text_of(desk_.home / "calls"); }
  void forget_calls() const { fs::remove(desk_.home / "calls"); }
  bool has_stamp() const { return fs::exists(project_ / "build/release/umbsim.stamp"); }
  std::size_t count(const std::string& tool) const {
    std::istringstream lines(calls());
    std::size_t n = 0;
    for (std::string line; std::getline(lines, line);) n += line.rfind(tool + " ", 0) == 0;
    return n;
  }

  /// After `change` ninja is asked, and from then on nobody.
  void expect_asks_ninja_after(const std::string& change) const {
    SCOPED_TRACE(change);
    ASSERT_EQ(in_project(change).code, 0);
    forget_calls();
    EXPECT_EQ(launch().code, 0);
    EXPECT_GE(count("ninja"), 1u);  // CMake, where it runs again, asks it, too
    forget_calls();
    EXPECT_EQ(launch().code, 0);
    EXPECT_EQ(calls(), "") << "asked already";
  }

  const std::string kCommit = "git -c user.name=a -c user.email=a@b commit -q --allow-empty -m ";
  Desk desk_;
  fs::path project_ = desk_.home / "project";
};

TEST_F(Launcher, AsksNobodyWhereNothingChanged) {
  const Outcome again = in_project("./umbsim one 'two words'");
  EXPECT_EQ(again.code, 0);
  EXPECT_EQ(again.err, "");
  expect_says(again.out, {"says hello one two words"});
  EXPECT_EQ(calls(), "");
}

TEST_F(Launcher, BuildsWhatChanged) {
  put_main("good day", "true");
  const Outcome changed = launch();
  EXPECT_EQ(changed.err, "") << "a build in a pipe is quiet";
  expect_says(changed.out, {"says good day"});
}

TEST_F(Launcher, SeesFilesThatChangeComeAndGo) {
  expect_asks_ninja_after("echo >> CMakeLists.txt");
  expect_asks_ninja_after("echo >> CMakePresets.json");
  expect_asks_ninja_after("echo '# more' >> core/CMakeLists.txt");
  expect_asks_ninja_after("echo '# more' >> cmake/WriteCommit.cmake");
  expect_asks_ninja_after("mkdir -p core/web && echo > core/web/page.js");
  expect_asks_ninja_after("touch -d 2001-01-01 core/web/page.js");
  expect_asks_ninja_after("mv core/web/page.js core/web/view.js");
  expect_asks_ninja_after("rm core/web/view.js");
  expect_asks_ninja_after("rm build/release/umbsim");
  expect_asks_ninja_after("echo '# by hand' >> build/release/umbsim");
  expect_asks_ninja_after("rm build/release/umbsim.stamp");
}

TEST_F(Launcher, WhatItDoesNotBuildFromCostsNothing) {
  ASSERT_EQ(in_project("mkdir -p results/umbmark && echo > results/umbmark/a && echo > table.csv").code, 0);
  ASSERT_EQ(launch().code, 0);
  EXPECT_EQ(calls(), "");
}

TEST_F(Launcher, TheProgramKnowsItsCommit) {
  const auto described = [&] { return in_project("git describe --always --dirty=+ --abbrev=12").out.substr(0, 12); };
  expect_says(launch().out, {"UMBSIM_COMMIT \"" + described() + "\""});
  ASSERT_EQ(in_project(kCommit + "two").code, 0);
  expect_says(launch().out, {"UMBSIM_COMMIT \"" + described() + "\""});
  put("README.md", "changed\n");
  expect_says(launch().out, {"UMBSIM_COMMIT \"" + described() + "+\""});
  forget_calls();
  launch();
  EXPECT_EQ(calls(), "");
}

TEST_F(Launcher, WhereNpmCannotBeReachedTheProgramIsBuiltWithoutPages) {
  EXPECT_EQ(cached("UMBSIM_PAGES"), "ON\n");
  put_fetch("echo 'npm ERR! network' >&2; exit 1");
  put_main("plain", "true");
  const Outcome without = launch();
  EXPECT_EQ(without.code, 0) << without.err;
  expect_says(without.out, {"says plain"});
  expect_says(without.err, {"umbsim: npm cannot be reached: the program is built without pages", "npm.log"});
  EXPECT_EQ(std::count(without.err.begin(), without.err.end(), '\n'), 1) << without.err;
  EXPECT_EQ(cached("UMBSIM_PAGES"), "OFF\n");
  put_fetch("true");
  put_main("with pages", "true");
  EXPECT_EQ(launch().err, "");
  EXPECT_EQ(cached("UMBSIM_PAGES"), "ON\n");
}

TEST_F(Launcher, AFailedBuildIsToldAndTriedAgain) {
  put_main("never", "echo 'main.sh: 7: no such thing' >&2; false");
  for (int i = 0; i < 2; ++i) {
    const Outcome failed = launch();
    EXPECT_EQ(failed.code, kFailed);
    EXPECT_EQ(failed.out, "") << "an older program must not run";
    expect_says(failed.err, {"no such thing", "umbsim: building failed", "build.log"});
    EXPECT_FALSE(has_stamp());
  }
  put_main("mended", "true");
  expect_says(launch().out, {"says mended"});
  put("CMakeLists.txt", "cmake_minimum_required(VERSION 3.25)\nno_such_command()\n");
  const Outcome failed = launch();
  EXPECT_EQ(failed.code, kFailed);
  expect_says(failed.err, {"no_such_command"});
  EXPECT_FALSE(has_stamp());
}

TEST_F(Launcher, AnInterruptedBuildLeavesNoStamp) {
  const std::string started = (desk_.home / "started").string();
  put_main("slow", "touch " + started + "; sleep 4");
  for (const std::string signal : {"KILL", "INT", "TERM"}) {
    // A group of its own, as a terminal makes one; its processes all get the signal.
    fs::remove(started);
    const Outcome ended = in_project("set -m; ./umbsim & for i in {1..200}; do test -e " + started +
                                     " && break; sleep 0.1; done; kill -" + signal + " -- -$!; wait $!");
    EXPECT_TRUE(fs::exists(started)) << "it was not building yet";
    EXPECT_NE(ended.code, 0);
    EXPECT_EQ(ended.out, "");
    EXPECT_FALSE(has_stamp()) << signal;
  }
  put_main("quick", "true");
  expect_says(launch().out, {"says quick"});
}

TEST_F(Launcher, SeveralAtOnceBuildOnce) {
  put_main("together", "sleep 1");
  const Outcome all = in_project("for i in 1 2 3; do ./umbsim $i & done; wait");
  EXPECT_EQ(all.err, "");
  expect_says(all.out, {"says together 1", "says together 2", "says together 3"});
  EXPECT_EQ(count("ninja"), 1u) << calls();
}

TEST_F(Launcher, InstallsWhatIsMissingWithOneQuestion) {
  install("libtbb-dev");
  const Outcome outcome = launch();
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  expect_says(outcome.err, {"installing from Debian: libtbb-dev\n"});
  EXPECT_EQ(count("dpkg-query"), 1u);
  expect_says(calls(), {"apt-get install -y -q --no-install-recommends libtbb-dev\n"});
  forget_calls();
  EXPECT_EQ(launch().err, "");
  EXPECT_EQ(calls(), "");
}

TEST_F(Launcher, OnATerminalOneLineOfProgress) {
  put_main("seen", "true");
  const Outcome built = in_project("script -qec ./umbsim /dev/null");
  expect_says(built.out, {"umbsim: building ... ", "%", "says seen"});
  for (const char* raw : {"[1/", "ninja:", "tiny", "\n\n"})
    EXPECT_EQ(built.out.find(raw), std::string::npos) << built.out;
  const Outcome again = in_project("script -qec ./umbsim /dev/null");
  EXPECT_EQ(again.out.rfind("says seen", 0), 0u) << again.out;
}

TEST_F(Launcher, AProjectThatMovedIsBuiltAgain) {
  fs::rename(project_, desk_.home / "moved");
  fs::create_directory(project_);
  const Outcome outcome = in_project("cd ../moved && ./umbsim");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  expect_says(text_of(desk_.home / "moved/build/release/CMakeCache.txt"),
              {"CMAKE_HOME_DIRECTORY:INTERNAL=" + (desk_.home / "moved").string()});
}

}  // namespace
}  // namespace umbsim::acceptance
