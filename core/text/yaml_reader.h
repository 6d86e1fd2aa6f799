#pragma once

#include <yaml-cpp/yaml.h>

#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/error.h"

namespace umbsim {

/// Closed or open bounds of a number. Written out in the error message.
struct Bounds {
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
  bool min_open = false;

  static Bounds positive() { return {0, std::numeric_limits<double>::infinity(), true}; }
  static Bounds at_least(double min) { return {min, std::numeric_limits<double>::infinity(), false}; }
  static Bounds between(double min, double max) { return {min, max, false}; }
  bool contains(double value) const { return (min_open ? value > min : value >= min) && value <= max; }
  std::string text() const;
};

/// One value of a YAML document together with its file and key path, for strict reading.
/// Every accessor throws InputError with file:line:column, key path, value and bound.
class YamlValue {
 public:
  YamlValue(const YAML::Node& node, std::string file, std::string path);
  YamlValue(const YamlValue&) = default;
  /// Makes this value stand for the other one. (YAML::Node's own assignment would overwrite the document.)
  YamlValue& operator=(const YamlValue& other);

  /// Parses a whole file. Throws InputError if it cannot be read, is not YAML, or has a duplicate key anywhere.
  static YamlValue load(const std::string& file);
  static YamlValue parse(const std::string& text, const std::string& file);

  double number(Bounds bounds = {}) const;
  std::int64_t integer(std::int64_t min, std::int64_t max) const;
  bool boolean() const;
  std::string string() const;
  std::string choice(const std::vector<std::string>& choices) const;
  std::vector<YamlValue> list() const;
  bool is_map() const { return node_.IsMap(); }
  bool is_list() const { return node_.IsSequence(); }
  const YAML::Node& node() const { return node_; }
  const std::string& path() const { return path_; }
  const std::string& file() const { return file_; }
  SourceMark mark() const;
  [[noreturn]] void fail(const std::string& what) const;

 private:
  friend class YamlMap;
  YAML::Node node_;
  std::string file_;
  std::string path_;
};

/// A map read key by key. `finish` throws for keys nobody asked for and lists those that exist.
class YamlMap {
 public:
  explicit YamlMap(const YamlValue& value);

  bool has(const std::string& key) const;
  std::optional<YamlValue> find(const std::string& key);
  /// Throws if the key is missing.
  YamlValue at(const std::string& key);

  double number(const std::string& key, Bounds bounds);
  double number(const std::string& key, double fallback, Bounds bounds);
  std::int64_t integer(const std::string& key, std::int64_t fallback, std::int64_t min, std::int64_t max);
  bool boolean(const std::string& key, bool fallback);
  std::string string(const std::string& key, const std::string& fallback);
  std::string choice(const std::string& key, const std::string& fallback, const std::vector<std::string>& choices);

  /// Keys in file order with their values; marks all of them as asked for.
  std::vector<std::pair<std::string, YamlValue>> entries();
  void finish() const;
  const YamlValue& value() const { return value_; }

 private:
  YamlValue value_;
  std::map<std::string, YAML::Node> nodes_;  // by key, the first of each: yaml-cpp goes through all for every question
  std::set<std::string> asked_;
};

/// "did you mean 'wheelbase'? " style help: the nearest of `choices`, then all of them.
std::string list_choices(const std::string& wrong, const std::vector<std::string>& choices);

}  // namespace umbsim
