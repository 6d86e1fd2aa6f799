#include "core/text/yaml_reader.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "core/text/choices.h"
#include "core/text/text_file.h"
#include "core/text/yaml_check.h"

namespace umbsim {
namespace {

constexpr std::size_t kMaxYamlBytes = 16u << 20;
constexpr std::size_t kMaxShownCharacters = 60;

// yaml-cpp tags a plain scalar "?"; quotes or an explicit tag make it something else.
bool is_plain(const YAML::Node& node) { return node.IsScalar() && node.Tag() == "?"; }

std::string describe(const YAML::Node& node) {
  if (node.IsMap()) return "a map";
  if (node.IsSequence()) return "a list";
  if (!node.IsScalar()) return "nothing";
  std::string text = node.Scalar();
  if (text.size() > kMaxShownCharacters) text = text.substr(0, kMaxShownCharacters) + "...";
  return is_plain(node) ? "'" + text + "'" : "the string \"" + text + "\"";
}

/// The number that the whole of `text` spells, if it does; a leading + is allowed.
template <typename Number>
std::optional<Number> parse_number(std::string_view text) {
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

bool is_non_finite_word(std::string_view text) {
  std::string word;
  for (const char c : text) word += char(std::tolower(static_cast<unsigned char>(c)));
  if (!word.empty() && (word[0] == '+' || word[0] == '-')) word.erase(0, 1);
  return word == ".inf" || word == ".nan" || word == "inf" || word == "infinity" || word == "nan";
}

std::string join_path(const std::string& parent, const std::string& key) {
  return parent.empty() ? key : parent + "." + key;
}

}  // namespace

std::string Bounds::text() const {
  std::string out;
  if (std::isfinite(min)) out = fmt::format("{} {}", min_open ? ">" : ">=", min);
  if (std::isfinite(max)) out += fmt::format("{}<= {}", out.empty() ? "" : " and ", max);
  return out.empty() ? "finite" : out;
}

YamlValue::YamlValue(const YAML::Node& node, std::string file, std::string path)
    : node_(node), file_(std::move(file)), path_(std::move(path)) {}

YamlValue& YamlValue::operator=(const YamlValue& other) {
  node_.reset(other.node_);
  file_ = other.file_;
  path_ = other.path_;
  return *this;
}

YamlValue YamlValue::load(const std::string& file) { return parse(read_text_file(file, kMaxYamlBytes), file); }

YamlValue YamlValue::parse(const std::string& text, const std::string& file) {
  check_yaml(text, file);
  return YamlValue(YAML::Load(text), file, "");
}

double YamlValue::number(Bounds bounds) const {
  const bool plain = is_plain(node_);
  const auto value = plain ? parse_number<double>(node_.Scalar()) : std::nullopt;
  if (plain && (is_non_finite_word(node_.Scalar()) || (value && !std::isfinite(*value)))) {
    fail("expected a finite number, got " + describe(node_));
  }
  if (!value) fail("expected a number, got " + describe(node_));
  if (!bounds.contains(*value)) fail(fmt::format("{} is out of range (must be {})", node_.Scalar(), bounds.text()));
  return *value;
}

std::int64_t YamlValue::integer(std::int64_t min, std::int64_t max) const {
  const auto value = is_plain(node_) ? parse_number<std::int64_t>(node_.Scalar()) : std::nullopt;
  if (!value) fail("expected an integer, got " + describe(node_));
  if (*value < min || *value > max) {
    const auto upper = max == std::numeric_limits<std::int64_t>::max() ? "" : fmt::format(" and <= {}", max);
    fail(fmt::format("{} is out of range (must be >= {}{})", *value, min, upper));
  }
  return *value;
}

bool YamlValue::boolean() const {
  const bool is_true = is_plain(node_) && node_.Scalar() == "true";
  if (!is_true && !(is_plain(node_) && node_.Scalar() == "false"))
    fail("expected true or false, got " + describe(node_));
  return is_true;
}

std::string YamlValue::string() const {
  if (!node_.IsScalar()) fail("expected text, got " + describe(node_));
  return node_.Scalar();
}

std::string YamlValue::choice(const std::vector<std::string>& choices) const {
  const std::string chosen = string();
  if (std::find(choices.begin(), choices.end(), chosen) == choices.end()) {
    fail(fmt::format("unknown value {}; {}", describe(node_), list_choices(chosen, choices)));
  }
  return chosen;
}

std::vector<YamlValue> YamlValue::list() const {
  if (!node_.IsSequence()) fail("expected a list, got " + describe(node_));
  std::vector<YamlValue> items;
  items.reserve(node_.size());
  for (const auto& item : node_) items.emplace_back(item, file_, fmt::format("{}[{}]", path_, items.size()));
  return items;
}

SourceMark YamlValue::mark() const { return {file_, node_.Mark().line + 1, node_.Mark().column + 1}; }

void YamlValue::fail(const std::string& what) const {
  throw InputError(mark(), path_.empty() ? what : path_ + ": " + what);
}

YamlMap::YamlMap(const YamlValue& value) : value_(value) {
  if (!value.is_map()) value.fail("expected a map (key: value), got " + describe(value.node_));
  for (const auto& entry : value.node_) nodes_.emplace(entry.first.Scalar(), entry.second);
}

bool YamlMap::has(const std::string& key) const { return nodes_.count(key) > 0; }

std::optional<YamlValue> YamlMap::find(const std::string& key) {
  asked_.insert(key);
  const auto found = nodes_.find(key);
  if (found == nodes_.end()) return std::nullopt;
  return YamlValue(found->second, value_.file_, join_path(value_.path_, key));
}

YamlValue YamlMap::at(const std::string& key) {
  if (auto found = find(key)) return *found;
  throw InputError(value_.mark(), join_path(value_.path_, key) + ": this key is missing");
}

double YamlMap::number(const std::string& key, Bounds bounds) { return at(key).number(bounds); }

double YamlMap::number(const std::string& key, double fallback, Bounds bounds) {
  const auto found = find(key);
  return found ? found->number(bounds) : fallback;
}

std::int64_t YamlMap::integer(const std::string& key, std::int64_t fallback, std::int64_t min, std::int64_t max) {
  const auto found = find(key);
  return found ? found->integer(min, max) : fallback;
}

bool YamlMap::boolean(const std::string& key, bool fallback) {
  const auto found = find(key);
  return found ? found->boolean() : fallback;
}

std::string YamlMap::string(const std::string& key, const std::string& fallback) {
  const auto found = find(key);
  return found ? found->string() : fallback;
}

std::string YamlMap::choice(const std::string& key, const std::string& fallback,
                            const std::vector<std::string>& choices) {
  const auto found = find(key);
  return found ? found->choice(choices) : fallback;
}

std::vector<std::pair<std::string, YamlValue>> YamlMap::entries() {
  std::vector<std::pair<std::string, YamlValue>> out;
  for (const auto& entry : value_.node_) {
    const std::string& key = entry.first.Scalar();
    asked_.insert(key);
    out.emplace_back(key, YamlValue(entry.second, value_.file_, join_path(value_.path_, key)));
  }
  return out;
}

void YamlMap::finish() const {
  for (const auto& entry : value_.node_) {
    const std::string& key = entry.first.Scalar();
    if (asked_.count(key) > 0) continue;
    const std::string help = list_choices(key, {asked_.begin(), asked_.end()});
    YamlValue(entry.first, value_.file_, join_path(value_.path_, key)).fail("unknown key; " + help);
  }
}

std::string list_choices(const std::string& wrong, const std::vector<std::string>& choices) {
  if (choices.empty()) return "nothing is accepted here";
  const std::string hint = did_you_mean(wrong, choices);
  constexpr std::size_t kLongList = 40, kFew = 5;
  if (choices.size() <= kLongList) return fmt::format("{}one of: {}", hint, fmt::join(choices, ", "));
  return fmt::format("{}one of {} names; the nearest are: {}", hint, choices.size(),
                     fmt::join(nearest_few(wrong, choices, kFew), ", "));
}

}  // namespace umbsim
