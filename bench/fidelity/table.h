#pragma once

#include <string>
#include <vector>

namespace umbsim::fidelity {

/// A Markdown table. Cells are text: the caller knows how many digits mean something.
class Table {
 public:
  explicit Table(const std::vector<std::string>& header) : text_(line(header)) {
    text_ += "|";
    for (std::size_t i = 0; i < header.size(); ++i) text_ += i == 0 ? "---|" : "---:|";
    text_ += "\n";
  }
  void row(const std::vector<std::string>& cells) { text_ += line(cells); }
  std::string text() const { return text_ + "\n"; }

 private:
  static std::string line(const std::vector<std::string>& cells) {
    std::string text = "|";
    for (const std::string& cell : cells) text += " " + cell + " |";
    return text + "\n";
  }
  std::string text_;
};

}  // namespace umbsim::fidelity
