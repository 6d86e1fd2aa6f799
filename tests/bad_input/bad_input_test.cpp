// Every case of corpus/ ends with exit code 2 and a message that says what is wrong with what; it takes less than two
// seconds of processor time, and leaves nothing behind.
#include <sys/resource.h>

#include "tests/bad_input/corpus.h"

namespace umbsim::acceptance {
namespace {

constexpr int kBadInput = 2;
constexpr double kMost_s = 2;
// Far beyond, for a machine that does other things: a program that hangs is ended.
constexpr const char* kHangs = "timeout -k 1 60 ";

const fs::path kCorpus = fs::path(UMBSIM_SOURCE_DIR) / "tests/bad_input/corpus";

std::vector<std::string> corpus_files() {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(kCorpus)) names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

double children_s() {
  rusage usage{};
  getrusage(RUSAGE_CHILDREN, &usage);
  const auto seconds = [](const timeval& t) { return double(t.tv_sec) + 1e-6 * double(t.tv_usec); };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

/// Names, kinds and sizes of all that lies in the case's folder.
std::string things_in(const Desk& desk) {
  return desk.shell("find . -mindepth 1 \\( -type f -printf '%p %s\\n' \\) -o -printf '%p %y\\n' | sort").out;
}

void expect_refused(const BadCase& c) {
  SCOPED_TRACE(c.where + ": " + c.name);
  const Desk desk;
  for (const auto& [name, text] : c.files) desk.put(name, text);
  const std::string source = "export SRC=" + shell_quoted(UMBSIM_SOURCE_DIR) + "; ";
  for (const std::string& line : c.setup) {
    const Outcome done = desk.shell(source + line);
    ASSERT_EQ(done.code, 0) << line << "\n" << done.err;
  }
  const auto before = things_in(desk);
  const double begin_s = children_s();
  const Outcome outcome = desk.shell(source + kHangs + shell_quoted(UMBSIM_PROGRAM) + c.command);
  EXPECT_LT(children_s() - begin_s, kMost_s);
  EXPECT_EQ(outcome.code, kBadInput) << outcome.out << outcome.err;
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(outcome.err.rfind("umbsim: ", 0), 0u) << outcome.err;
  EXPECT_LT(outcome.err.size(), 4000u) << outcome.err.substr(0, 400);
  expect_says(unwrapped(outcome.err), c.says);
  EXPECT_EQ(things_in(desk), before) << "something was left behind or changed";
}

class BadInput : public testing::TestWithParam<std::string> {};

TEST_P(BadInput, IsNamedAndNothingIsWritten) {
  const std::vector<BadCase> cases = read_cases(kCorpus / (GetParam() + ".txt"));
  ASSERT_FALSE(cases.empty());
  for (const BadCase& c : cases) {
    EXPECT_FALSE(c.says.empty()) << c.where << " expects nothing of the message";
    expect_refused(c);
  }
}

INSTANTIATE_TEST_SUITE_P(Corpus, BadInput, testing::ValuesIn(corpus_files()),
                         [](const auto& param_info) { return param_info.param; });

TEST(BadInput, ThereAreMany) {
  std::size_t count = 0;
  for (const std::string& name : corpus_files()) count += read_cases(kCorpus / (name + ".txt")).size();
  EXPECT_GE(count, 200u);
}

}  // namespace
}  // namespace umbsim::acceptance
