// The documents are for people: short paragraphs, and links that lead to a heading that is there.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace umbsim::acceptance {
namespace {

namespace fs = std::filesystem;

constexpr int kMostWords = 120;  // of a paragraph, a list item or a row of a table

/// A paragraph, a list item or a row of a table.
struct Piece {
  int line = 0;
  int words = 0;
  std::string begin;
};

bool starts_item(const std::string& text) {
  if (text.rfind("- ", 0) == 0 || text.rfind("* ", 0) == 0 || text[0] == '|') return true;
  const std::size_t digits = text.find_first_not_of("0123456789");
  return digits > 0 && digits != std::string::npos && text.compare(digits, 2, ". ") == 0;
}

/// Lines outside fenced blocks, without the blanks around them; a line of a fence is empty.
std::vector<std::string> prose_of(std::istream& page) {
  std::vector<std::string> lines;
  bool fenced = false;
  for (std::string line; std::getline(page, line);) {
    const std::size_t from = line.find_first_not_of(" \t");
    line = from == std::string::npos ? "" : line.substr(from);
    const bool fence = line.rfind("```", 0) == 0;
    lines.push_back(fenced || fence ? "" : line);
    fenced = fenced != fence;
  }
  return lines;
}

std::vector<Piece> pieces_of(std::istream& page) {
  std::vector<Piece> pieces;
  bool open = false;
  const std::vector<std::string> lines = prose_of(page);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const std::string& text = lines[i];
    const bool between = text.empty() || text[0] == '#' || text.rfind("<!--", 0) == 0;
    if (between || starts_item(text)) open = false;
    if (between) continue;
    if (!open) pieces.push_back({int(i) + 1, 0, text.substr(0, 60)});
    open = true;
    std::istringstream words(text);
    for (std::string word; words >> word;) ++pieces.back().words;
  }
  return pieces;
}

/// The name by which a heading is linked to, as GitHub makes it.
std::string anchor_of(const std::string& heading) {
  std::string anchor;
  for (const char c : heading.substr(heading.find_first_not_of("# "))) {
    const auto byte = static_cast<unsigned char>(c);
    if (std::isalnum(byte) || c == '-' || c == '_' || byte >= 0x80) anchor += char(std::tolower(byte));
    if (c == ' ') anchor += '-';
  }
  return anchor;
}

std::set<std::string> anchors_of(const fs::path& page) {
  std::set<std::string> anchors;
  std::ifstream file(page);
  for (const std::string& line : prose_of(file)) {
    if (line.rfind('#', 0) == 0) anchors.insert(anchor_of(line));
  }
  return anchors;
}

std::vector<fs::path> page_files() {
  const fs::path root = UMBSIM_SOURCE_DIR;
  std::vector<fs::path> all{root / "README.md"};
  for (const auto& entry : fs::directory_iterator(root / "docs")) {
    if (entry.path().extension() == ".md") all.push_back(entry.path());
  }
  std::sort(all.begin(), all.end());
  return all;
}

TEST(Pages, HaveNoLongParagraph) {
  for (const fs::path& page : page_files()) {
    std::ifstream file(page);
    for (const Piece& piece : pieces_of(file))
      EXPECT_LE(piece.words, kMostWords) << page.filename() << ":" << piece.line << ": " << piece.begin;
  }
}

TEST(Pages, PiecesAreParagraphsItemsAndRows) {
  std::istringstream page("# One two\n\nthree four\nfive\n- six\n  seven\n1. eight\n```\nnine\n```\n| ten |\n");
  std::vector<int> words;
  for (const Piece& piece : pieces_of(page)) words.push_back(piece.words);
  EXPECT_EQ(words, (std::vector<int>{3, 3, 2, 3}));
}

// "](page.md#heading)" and "](#heading)" of a page lead to a heading that is there.
TEST(Pages, LinksLeadToHeadings) {
  for (const fs::path& page : page_files()) {
    std::ifstream file(page);
    for (const std::string& line : prose_of(file)) {
      for (std::size_t at = line.find("]("); at != std::string::npos; at = line.find("](", at + 1)) {
        const std::string target = line.substr(at + 2, line.find(')', at) - at - 2);
        const std::size_t hash = target.find('#');
        if (hash == std::string::npos || target.find("://") != std::string::npos) continue;
        const fs::path to = hash == 0 ? page : page.parent_path() / target.substr(0, hash);
        EXPECT_EQ(anchors_of(to).count(target.substr(hash + 1)), 1u) << page.filename() << " links to " << target;
      }
    }
  }
}

// Every page is in the index.
TEST(Pages, AreInTheIndex) {
  std::ifstream file(fs::path(UMBSIM_SOURCE_DIR) / "docs/README.md");
  std::stringstream index;
  index << file.rdbuf();
  for (const fs::path& page : page_files()) {
    if (page.filename() == "README.md") continue;
    EXPECT_NE(index.str().find("](" + page.filename().string() + ")"), std::string::npos)
        << page.filename() << " is not in docs/README.md";
  }
}

}  // namespace
}  // namespace umbsim::acceptance
