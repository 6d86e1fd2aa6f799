#include "exchange/bag/messages/idl.h"

#include <fmt/format.h>

#include <cctype>
#include <map>

#include "core/error.h"
#include "exchange/bag/messages/array_length.h"

namespace umbsim::exchange {
namespace {

/// Words, numbers, strings and single signs; comments and the lines between files are left out.
std::vector<std::string> tokens_of(const std::string& text) {
  std::vector<std::string> tokens;
  for (std::size_t i = 0; i < text.size();) {
    const char c = text[i];
    if (std::isspace(static_cast<unsigned char>(c))) {
      ++i;
    } else if (text.compare(i, 2, "//") == 0 || c == '#' || text.compare(i, 4, "====") == 0 ||
               text.compare(i, 5, "IDL: ") == 0) {
      i = std::min(text.find('\n', i), text.size());
    } else if (text.compare(i, 2, "/*") == 0) {
      i = std::min(text.find("*/", i), text.size() - 2) + 2;
    } else if (c == '"') {
      std::size_t end = i + 1;
      while (end < text.size() && text[end] != '"') end += text[end] == '\\' ? 2 : 1;
      tokens.emplace_back("\"");
      i = end + 1;
    } else if (std::isalnum(static_cast<unsigned char>(c)) || c == '_') {
      std::size_t end = i;
      while (end < text.size() &&
             (std::isalnum(static_cast<unsigned char>(text[end])) || text[end] == '_' || text[end] == '.'))
        ++end;
      tokens.push_back(text.substr(i, end - i));
      i = end;
    } else if (text.compare(i, 2, "::") == 0) {
      tokens.emplace_back("::");
      i += 2;
    } else {
      tokens.emplace_back(1, c);
      ++i;
    }
  }
  return tokens;
}

/// A type as it stands before a name.
struct Type {
  std::string name;
  bool is_array = false;
  std::size_t count = 0;
};

class Parser {
 public:
  explicit Parser(const std::string& text) : tokens_(tokens_of(text)) {}

  Definitions parse() {
    while (at_ < tokens_.size()) declaration();
    return all_;
  }

 private:
  std::string next() {
    if (at_ >= tokens_.size()) throw InputError("an IDL definition ends in the middle");
    return tokens_[at_++];
  }
  bool is(const std::string& token) const { return at_ < tokens_.size() && tokens_[at_] == token; }
  void expect(const std::string& token) {
    const std::string found = next();
    if (found != token)
      throw InputError(fmt::format("an IDL definition has '{}' where '{}' is expected", found, token));
  }
  void skip_to(const std::string& token) {
    while (next() != token) {
    }
  }

  // @key or @verbatim (language="comment", text="..." "...")
  void annotation() {
    next();
    if (!is("(")) return;
    int depth = 0;
    do {
      const std::string token = next();
      depth += token == "(" ? 1 : token == ")" ? -1 : 0;
    } while (depth > 0);
  }

  void declaration() {
    const std::string word = next();
    if (word == "@")
      annotation();
    else if (word == "module") {
      module_.push_back(next());
      expect("{");
    } else if (word == "}") {
      if (!module_.empty()) module_.pop_back();
      if (is(";")) next();
    } else if (word == "struct")
      structure();
    else if (word == "typedef")
      alias();
    else
      skip_to(";");  // const
  }

  void structure() {
    std::string scope;
    for (const std::string& m : module_) scope += m + "/";
    std::vector<Field>& fields = all_[short_type(scope + next())];
    expect("{");
    while (!is("}")) {
      if (is("@")) {
        next();
        annotation();
        continue;
      }
      const Type type = read_type();
      Field f{next(), type.name, type.is_array, type.count};
      if (is("[")) {
        next();
        f.is_array = true;
        f.count = array_length(next());
        expect("]");
      }
      expect(";");
      fields.push_back(f);
    }
    next();
    if (is(";")) next();
  }

  void alias() {
    Type type = read_type();
    const std::string name = next();
    if (is("[")) {
      next();
      type.is_array = true;
      type.count = array_length(next());
      expect("]");
    }
    expect(";");
    aliases_[name] = type;
  }

  Type read_type() {
    static const std::map<std::string, std::string> kNames = {
        {"double", "float64"}, {"float", "float32"}, {"boolean", "bool"},  {"octet", "uint8"},    {"char", "uint8"},
        {"short", "int16"},    {"long", "int32"},    {"string", "string"}, {"wstring", "wstring"}};
    std::string word = next();
    if (word == "sequence") {
      expect("<");
      Type inner = read_type();
      if (is(",")) {
        next();
        next();
      }
      expect(">");
      inner.is_array = true;
      inner.count = 0;
      return inner;
    }
    if (word == "unsigned") {
      const Type inner = read_type();
      return {"u" + inner.name, false, 0};
    }
    if (word == "long" && is("long")) {
      next();
      return {"int64", false, 0};
    }
    if (const auto found = kNames.find(word); found != kNames.end()) {
      if (is("<")) skip_to(">");
      return {found->second, false, 0};
    }
    std::string last = word;
    while (is("::")) {
      next();
      last = next();
      word += "/" + last;
    }
    if (const auto found = aliases_.find(last); found != aliases_.end()) return found->second;
    return {is_primitive(word) ? word : short_type(word), false, 0};
  }

  std::vector<std::string> tokens_;
  std::size_t at_ = 0;
  std::vector<std::string> module_;
  std::map<std::string, Type> aliases_;
  Definitions all_;
};

}  // namespace

Definitions parse_idl(const std::string& text) { return Parser(text).parse(); }

}  // namespace umbsim::exchange
