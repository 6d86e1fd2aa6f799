#include "core/text/yaml_check.h"

#include <fmt/format.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/yaml.h>

#include <map>
#include <sstream>
#include <vector>

#include "core/error.h"

namespace umbsim {
namespace {

/// Follows the parser's events and refuses what a strict document must not contain.
class StrictEvents : public YAML::EventHandler {
 public:
  explicit StrictEvents(const std::string& file) : file_(file) {}

  void OnDocumentStart(const YAML::Mark& mark) override {
    if (++documents_ > 1) fail(mark, "a second document begins here; one file holds one document");
  }
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& mark, YAML::anchor_t) override {
    if (open_.empty()) fail(mark, "the file is empty");
    if (expects_key()) fail(mark, "a key is missing before ':'");
    value_done();
  }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t) override {
    fail(mark, "aliases (*name) are not read; write the value out");
  }
  void OnScalar(const YAML::Mark& mark, const std::string&, YAML::anchor_t, const std::string& value) override {
    count(mark);
    if (expects_key()) return add_key(mark, value);
    value_done();
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t, YAML::EmitterStyle::value) override {
    open(mark, false);
  }
  void OnSequenceEnd() override { close(); }
  void OnMapStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t, YAML::EmitterStyle::value) override {
    open(mark, true);
  }
  void OnMapEnd() override { close(); }

  int documents() const { return documents_; }
  /// A map or list stands where a key belongs. Without its closing bracket yaml-cpp takes it for one before it
  /// complains.
  bool odd_key() const { return odd_key_; }

 private:
  struct Level {
    bool is_map;
    std::map<std::string, int> lines = {};  ///< of a map: where each key stands
    std::string key = {};                   ///< of a map: the key whose value is being read
    bool has_key = false;
    int index = 0;  ///< of a list: the item being read
  };

  bool expects_key() const { return !open_.empty() && open_.back().is_map && !open_.back().has_key; }

  // yaml-cpp takes a kilobyte and some microseconds for each.
  void count(const YAML::Mark& mark) {
    if (++nodes_ > kMaxYamlNodes) fail(mark, fmt::format("more than {} keys and values in one file", kMaxYamlNodes));
  }

  void add_key(const YAML::Mark& mark, const std::string& key) {
    Level& map = open_.back();
    map.key = key;
    map.has_key = true;
    const auto [first, is_new] = map.lines.emplace(key, mark.line + 1);
    if (!is_new) fail(mark, fmt::format("{}: duplicate key (first on line {})", path(), first->second));
  }

  void open(const YAML::Mark& mark, bool is_map) {
    count(mark);
    odd_key_ = expects_key();
    if (odd_key_) fail(mark, "a key must be text, not a map or a list");
    if (open_.size() >= std::size_t(kMaxYamlDepth)) {
      fail(mark, fmt::format("maps and lists are nested deeper than {} levels", kMaxYamlDepth));
    }
    open_.push_back({is_map});
  }

  void close() {
    open_.pop_back();
    value_done();
  }

  void value_done() {
    if (open_.empty()) return;
    open_.back().has_key = false;
    ++open_.back().index;
  }

  std::string path() const {
    std::string text;
    for (const Level& level : open_) {
      if (!level.is_map) text += fmt::format("[{}]", level.index);
      if (level.is_map) text += (text.empty() ? "" : ".") + level.key;
    }
    return text;
  }

  [[noreturn]] void fail(const YAML::Mark& mark, const std::string& what) const {
    throw InputError(SourceMark{file_, mark.line + 1, mark.column + 1}, what);
  }

  std::string file_;
  std::vector<Level> open_;
  int documents_ = 0;
  int nodes_ = 0;
  bool odd_key_ = false;
};

/// Follows the parser's events and refuses nothing but what is nested too deeply to be read.
class AnyEvents : public YAML::EventHandler {
 public:
  explicit AnyEvents(const std::string& file) : file_(file) {}

  void OnDocumentStart(const YAML::Mark&) override {}
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark&, YAML::anchor_t) override {}
  void OnAlias(const YAML::Mark&, YAML::anchor_t) override {}
  void OnScalar(const YAML::Mark&, const std::string&, YAML::anchor_t, const std::string&) override {}
  void OnSequenceStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t, YAML::EmitterStyle::value) override {
    open(mark);
  }
  void OnSequenceEnd() override { --depth_; }
  void OnMapStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t, YAML::EmitterStyle::value) override {
    open(mark);
  }
  void OnMapEnd() override { --depth_; }

 private:
  void open(const YAML::Mark& mark) {
    if (++depth_ <= kMaxYamlDepth) return;
    throw InputError(SourceMark{file_, mark.line + 1, mark.column + 1},
                     fmt::format("maps and lists are nested deeper than {} levels", kMaxYamlDepth));
  }
  std::string file_;
  int depth_ = 0;
};

// yaml-cpp takes byte 4 for the end of the file and would drop the rest of the document without a word.
void check_characters(const std::string& text, const std::string& file) {
  SourceMark mark{file, 1, 0};
  for (const char c : text) {
    ++mark.column;
    const auto byte = static_cast<unsigned char>(c);
    if ((byte < 0x20 && c != '\n' && c != '\r' && c != '\t') || byte == 0x7f) {
      throw InputError(mark, fmt::format("control character 0x{:02x}; this is not a text file", byte));
    }
    if (c == '\n') mark = {file, mark.line + 1, 0};
  }
}

// Behind a bracket too many yaml-cpp finds documents without end: `documents` are read at most.
void parse_all(const std::string& text, const std::string& file, YAML::EventHandler& events, int documents) {
  std::istringstream stream(text);
  try {
    YAML::Parser parser(stream);
    while (documents-- > 0 && parser.HandleNextDocument(events)) {
    }
  } catch (const YAML::Exception& error) {
    const SourceMark mark{file, error.mark.line + 1, error.mark.column + 1};
    throw InputError(mark, "not valid YAML: " + error.msg);
  }
}

}  // namespace

void check_yaml(const std::string& text, const std::string& file) {
  check_characters(text, file);
  StrictEvents events(file);
  try {
    parse_all(text, file, events, 2);  // the second one is refused
  } catch (const InputError&) {
    AnyEvents any(file);
    if (events.odd_key()) parse_all(text, file, any, 1);
    throw;
  }
  if (events.documents() == 0) throw InputError(SourceMark{file, 1, 1}, "the file is empty");
}

}  // namespace umbsim
