#include "report/report.h"

#include <gtest/gtest.h>

#include <regex>
#include <stdexcept>
#include <string>

namespace umbsim {
namespace {

using nlohmann::json;

// Page, style and script without data; a page this large would mean that a library has crept in.
constexpr std::size_t kMaxEmptyPageBytes = 100'000;

std::string data_block(const std::string& page) {
  const std::string open = R"(<script type="application/json" id="report-data">)";
  const std::size_t begin = page.find(open) + open.size();
  return page.substr(begin, page.find("</script>", begin) - begin);
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + part.size())) ++n;
  return n;
}

TEST(Report, HoldsTheDataUnchanged) {
  const json data = {{"title", "UMBmark of labmate"},
                     {"summary", {{"umbmark", {{"e_max_syst_m", 0.311042}}}}},
                     {"runs", {{{"id", "cw-1"}, {"truth", {{0.0, 0.0, 0.0}, {0.1, 1e-9, -3.5}}}}}}};
  EXPECT_EQ(json::parse(data_block(render_report(data))), data);
}

TEST(Report, TextCannotLeaveTheDataBlock) {
  const json data = {{"title", "</script><script>alert(1)</script> & <!-- <b>"}, {"description", "a\u2028b\u2029c"}};
  const std::string page = render_report(data);
  const std::string empty = render_report(json::object());
  EXPECT_EQ(count(page, "<script"), count(empty, "<script"));
  EXPECT_EQ(count(page, "</script"), count(empty, "</script"));
  EXPECT_EQ(page.find("<!--"), std::string::npos);
  EXPECT_EQ(page.find("\u2028"), std::string::npos);
  EXPECT_EQ(page.find("\u2029"), std::string::npos);
  EXPECT_EQ(json::parse(data_block(page)), data);
  EXPECT_NE(page.find("<title>&lt;/script&gt;"), std::string::npos);
}

TEST(Report, PlaceholdersInTheDataStayText) {
  const json data = {{"title", "@SCRIPT@ @DATA@ @STYLE@ @TITLE@"}};
  const std::string page = render_report(data);
  EXPECT_EQ(json::parse(data_block(page)), data);
  EXPECT_EQ(count(page, "<title>@SCRIPT@ @DATA@ @STYLE@ @TITLE@</title>"), 1u);
}

TEST(Report, LoadsNothingFromElsewhere) {
  const std::string page = render_report(json::object());
  EXPECT_FALSE(std::regex_search(page, std::regex(R"((src|href)\s*=)")));
  EXPECT_FALSE(std::regex_search(page, std::regex(R"(https?://|url\((?!#)|@import|fetch\(|import\s)")));
}

TEST(Report, EveryWebFileIsInside) {
  const std::string page = render_report(json::object());
  for (const char* part : {"const mmUnit", "function clusterOf", "class Plot", "function setupScatter",
                           "function setupPaths", "function setupGrowth", "function umbmarkHtml",
                           "document.body.dataset.drawn", "prefers-color-scheme: dark", "@media print"}) {
    EXPECT_EQ(count(page, part), 1u) << part;
  }
}

TEST(Report, EveryWebFileOfTheGapPageIsInside) {
  const std::string page = render_gap_report(json::object());
  for (const char* part : {"const mmUnit", "class Plot", "function setupGapTracks", "function gapWhichHtml",
                           "function buildGapPage", "document.body.dataset.drawn"}) {
    EXPECT_EQ(count(page, part), 1u) << part;
  }
  EXPECT_FALSE(std::regex_search(page, std::regex(R"((src|href)\s*=)")));
  EXPECT_LT(page.size(), kMaxEmptyPageBytes);
}

TEST(Report, IsSmall) { EXPECT_LT(render_report(json::object()).size(), kMaxEmptyPageBytes); }

TEST(Report, InvalidUtf8IsReplacedNotFatal) { EXPECT_NO_THROW(render_report({{"title", "bad \xFF byte"}})); }

TEST(Report, DataMustBeAnObject) { EXPECT_THROW(render_report(json::array()), std::invalid_argument); }

}  // namespace
}  // namespace umbsim
