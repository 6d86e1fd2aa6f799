#include "exchange/bag/messages/message_reader.h"

#include <fastcdr/exceptions/Exception.h>
#include <fmt/format.h>

#include <algorithm>

#include "core/error.h"
#include "exchange/bag/messages/wire_reader.h"

namespace umbsim::exchange {
namespace {

constexpr int kDeepest = 30;  // structs in structs; no message has so many

}  // namespace

struct MessageReader::Node {
  enum class Kind { structure, boolean, i8, u8, i16, u16, i32, u32, i64, u64, f32, f64, text, wide_text };

  static Kind kind_of(const std::string& type) {
    static const std::map<std::string, Kind> kinds = {
        {"bool", Kind::boolean}, {"byte", Kind::u8},     {"char", Kind::u8},          {"int8", Kind::i8},
        {"uint8", Kind::u8},     {"int16", Kind::i16},   {"uint16", Kind::u16},       {"int32", Kind::i32},
        {"uint32", Kind::u32},   {"int64", Kind::i64},   {"uint64", Kind::u64},       {"float32", Kind::f32},
        {"float64", Kind::f64},  {"string", Kind::text}, {"wstring", Kind::wide_text}};
    const auto found = kinds.find(type);
    return found == kinds.end() ? Kind::structure : found->second;
  }

  Kind kind = Kind::structure;
  bool is_array = false;
  std::size_t count = 0;
  int slot = -1;  ///< in MessageValues; -1: not asked for
  std::vector<Node> fields;

  template <class Reader>
  void read(Reader& in, MessageValues& out) const {
    std::size_t repeats = 1;
    if (is_array) repeats = count > 0 ? count : in.template number<std::uint32_t>();
    for (std::size_t i = 0; i < repeats; ++i) read_one(in, out);
  }

  template <class Reader>
  void read_one(Reader& in, MessageValues& out) const {
    const auto keep = [&](auto value) {
      if (slot >= 0) out.numbers[std::size_t(slot)].push_back(double(value));
    };
    switch (kind) {
      case Kind::structure:
        for (const Node& f : fields) f.read(in, out);
        if (fields.empty()) in.empty_struct();
        break;
      case Kind::boolean:
      case Kind::u8:
        keep(in.template number<std::uint8_t>());
        break;
      case Kind::i8:
        keep(in.template number<std::int8_t>());
        break;
      case Kind::i16:
        keep(in.template number<std::int16_t>());
        break;
      case Kind::u16:
        keep(in.template number<std::uint16_t>());
        break;
      case Kind::i32:
        keep(in.template number<std::int32_t>());
        break;
      case Kind::u32:
        keep(in.template number<std::uint32_t>());
        break;
      case Kind::i64:
        keep(in.template number<std::int64_t>());
        break;
      case Kind::u64:
        keep(in.template number<std::uint64_t>());
        break;
      case Kind::f32:
        keep(in.template number<float>());
        break;
      case Kind::f64:
        keep(in.template number<double>());
        break;
      case Kind::wide_text:
        in.wide_text();
        break;
      case Kind::text: {
        std::string value = in.text();
        if (slot >= 0) out.texts[std::size_t(slot)].push_back(std::move(value));
        break;
      }
    }
  }
};

namespace {

/// Builds the tree of a type; `paths` that it meets are crossed out.
template <class Node>
Node build(const std::string& type, const Definitions& definitions, const std::string& path,
           const std::vector<std::string>& paths, std::vector<bool>& met, int depth) {
  Node node;
  node.kind = Node::kind_of(type);
  if (node.kind != Node::Kind::structure) {
    for (std::size_t i = 0; i < paths.size(); ++i) {
      if (paths[i] != path) continue;
      node.slot = int(i);
      met[i] = true;
    }
    return node;
  }
  if (depth > kDeepest) throw InputError(fmt::format("the definition of {} contains itself", type));
  static const std::vector<Field> kTime = {{"sec", "uint32", false, 0}, {"nanosec", "uint32", false, 0}};
  const bool is_time = type == "time" || type == "duration";
  const auto found = definitions.find(type);
  if (!is_time && found == definitions.end()) throw InputError(fmt::format("the bag does not define type {}", type));
  for (const Field& f : is_time ? kTime : found->second) {
    Node child = build<Node>(f.type, definitions, path.empty() ? f.name : path + "." + f.name, paths, met, depth + 1);
    child.is_array = f.is_array;
    child.count = f.count;
    node.fields.push_back(std::move(child));
  }
  return node;
}

}  // namespace

MessageReader::MessageReader(const std::string& type, const Definitions& definitions,
                             const std::vector<std::string>& paths, Wire wire)
    : type_(short_type(type)), paths_(paths.size()), wire_(wire) {
  std::vector<bool> met(paths.size(), false);
  root_ = std::make_unique<Node>(build<Node>(type_, definitions, "", paths, met, 0));
  for (std::size_t i = 0; i < paths.size(); ++i) {
    if (!met[i]) throw InputError(fmt::format("{} has no field '{}' in this bag's definition", type_, paths[i]));
  }
}

MessageReader::~MessageReader() = default;
MessageReader::MessageReader(MessageReader&&) noexcept = default;

void MessageReader::read(const std::uint8_t* data, std::size_t size, MessageValues& values) const {
  values.numbers.resize(paths_);
  values.texts.resize(paths_);
  for (auto& v : values.numbers) v.clear();
  for (auto& v : values.texts) v.clear();
  try {
    if (wire_ == Wire::cdr) {
      CdrReader in(data, size);
      root_->read(in, values);
    } else {
      Ros1Reader in(data, size);
      root_->read(in, values);
    }
  } catch (const eprosima::fastcdr::exception::Exception& e) {
    throw InputError(fmt::format("a message of {} bytes is no {}: {}", size, type_, e.what()));
  }
}

}  // namespace umbsim::exchange
