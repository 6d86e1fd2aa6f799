#include "report/report.h"

#include <gtest/gtest.h>

#include <regex>
#include <stdexcept>
#include <string>

namespace umbsim {
namespace {

using Json = nlohmann::ordered_json;

// Page, style and scripts without data. Charts and 3D engine make 1.1 MB; the page of ten runs must stay below 3 MB.
constexpr std::size_t kMaxEmptyPageBytes = 1'600'000;

std::string run_page(const Json& data) { return render_report(PageKind::run, data); }

Json with_kind(Json data, const char* kind) {
  data["page"] = kind;
  return data;
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + part.size())) ++n;
  return n;
}

TEST(Report, HoldsTheDataUnchanged) {
  const Json data = {{"title", "UMBmark of labmate"},
                     {"summary", {{"umbmark", {{"e_max_syst_m", 0.311042}}}}},
                     {"runs", {{{"id", "cw-1"}, {"truth", {{0.0, 0.0, 0.0}, {0.1, 1e-9, -3.5}}}}}}};
  ASSERT_TRUE(page_data(run_page(data)));
  EXPECT_EQ(nlohmann::json(*page_data(run_page(data))), nlohmann::json(with_kind(data, "run")));
}

TEST(Report, TextCannotLeaveTheDataBlock) {
  const Json data = {{"title", "</script><script>alert(1)</script> & <!-- <b>"}, {"description", "a\u2028b\u2029c"}};
  const std::string page = run_page(data);
  const std::string empty = run_page(Json::object());
  EXPECT_EQ(count(page, "<script"), count(empty, "<script"));
  EXPECT_EQ(count(page, "</script"), count(empty, "</script"));
  EXPECT_EQ(count(page, "<!--"), 0u);
  EXPECT_EQ(count(page, "\u2028"), count(empty, "\u2028"));
  EXPECT_EQ(count(page, "\u2029"), count(empty, "\u2029"));
  EXPECT_EQ(nlohmann::json(*page_data(page)), nlohmann::json(with_kind(data, "run")));
  EXPECT_NE(page.find("<title>&lt;/script&gt;"), std::string::npos);
}

TEST(Report, PlaceholdersInTheDataStayText) {
  const Json data = {{"title", "@REPLAY@ @DATA@ @STYLE@ @TITLE@"}};
  const std::string page = run_page(data);
  EXPECT_EQ((*page_data(page))["title"], data["title"]);
  EXPECT_EQ(count(page, "<title>@REPLAY@ @DATA@ @STYLE@ @TITLE@</title>"), 1u);
}

// The policy names the only scripts that may run, by their content; nothing is fetched.
TEST(Report, LoadsNothingFromElsewhere) {
  const std::string page = run_page(Json::object());
  EXPECT_TRUE(std::regex_search(
      page, std::regex(R"(content="default-src 'none'; style-src 'unsafe-inline'; img-src data: blob:; script-src 'sha256-[^']+' 'sha256-[^']+'")")));
  const std::string head = page.substr(0, page.find("<script"));
  EXPECT_EQ(count(head, "<link") + count(head, "@import") + count(head, "url("), 0u);
  EXPECT_EQ(count(page, "<script src"), 0u);
}

TEST(Report, ThreeDimensionsOnlyWhereSomethingMoves) {
  const std::string run = render_report(PageKind::run, Json::object());
  const std::string sweep = render_report(PageKind::sweep, Json::object());
  EXPECT_GT(run.size(), sweep.size() + 300'000);
  EXPECT_EQ(count(render_report(PageKind::gap, Json::object()), "@REPLAY@"), 0u);
}

TEST(Report, EveryKindSaysWhichItIs) {
  const std::pair<PageKind, const char*> kinds[] = {
      {PageKind::run, "run"},           {PageKind::recording, "recording"},     {PageKind::sweep, "sweep"},
      {PageKind::gap, "gap"},           {PageKind::calibration, "calibration"}, {PageKind::explanation, "explanation"},
      {PageKind::plan, "plan"},         {PageKind::prediction, "prediction"},   {PageKind::score, "score"},
      {PageKind::index, "index"}};
  for (const auto& [kind, name] : kinds)
    EXPECT_EQ((*page_data(render_report(kind, {{"page", "another"}})))["page"], name);
}

TEST(Report, IsSmall) { EXPECT_LT(run_page(Json::object()).size(), kMaxEmptyPageBytes); }

TEST(Report, InvalidUtf8IsReplacedNotFatal) { EXPECT_NO_THROW(run_page({{"title", "bad \xFF byte"}})); }

TEST(Report, DataMustBeAnObject) { EXPECT_THROW(run_page(Json::array()), std::invalid_argument); }

TEST(Report, AnotherPageHasNoData) {
  EXPECT_FALSE(page_data("<html></html>"));
  EXPECT_FALSE(page_data(R"(<script type="application/json" id="report-data">{"broken":</script>)"));
}

}  // namespace
}  // namespace umbsim
