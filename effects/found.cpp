// What was found of an effect, as text for a reader.
#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <stdexcept>

#include "core/pose2.h"
#include "effects/words.h"

namespace umbsim {
namespace {

struct UnitPair {
  const char* si;
  const char* shown;
  double factor;
};
constexpr UnitPair kUnits[] = {{"1", "%", 100},
                               {"1/run", "% per run", 100},
                               {"s/rad", "% per rad/s", 100},
                               {"1", "times", 1},
                               {"1", "ticks", 1},
                               {"1", "", 1},
                               {"m", "mm", 1e3},
                               {"m", "m", 1},
                               {"rad", "°", 180 / M_PI},
                               {"s", "ms", 1e3},
                               {"s", "s", 1},
                               {"kg", "kg", 1},
                               {"N m", "N m", 1},
                               {"N s", "N s", 1},
                               {"rad/s", "rad/s", 1},
                               {"rad/s per N m", "rad/s per N m", 1},
                               {"m/N", "µm/N", 1e6},
                               {"m/s per N", "mm/s per N", 1e3}};

const EffectParameter& parameter_of(const EffectInfo& info, const std::string& name) {
  for (const EffectParameter& p : info.parameters) {
    if (p.name == name) return p;
  }
  throw std::logic_error(info.name + " has no parameter " + name);
}

const ParameterWords& words_of(const EffectInfo& info, const std::string& parameter) {
  for (const ParameterWords& w : words_of(info).parameters) {
    if (w.name == parameter) return w;
  }
  throw std::logic_error(info.name + ": no words for " + parameter);
}

double factor_of(const EffectParameter& p, const std::string& shown_unit) {
  for (const UnitPair& u : kUnits) {
    if (p.unit == u.si && shown_unit == u.shown) return u.factor;
  }
  throw std::logic_error(p.name + " in " + p.unit + " cannot be shown in " + shown_unit);
}

/// A number in the unit that a reader sees.
struct Quantity {
  double value = 0;
  double low = 0;
  double high = 0;
  std::string unit;

  bool has_interval() const { return std::isfinite(low) && std::isfinite(high) && low < high; }
  // Two digits of the interval's width; without one three of the value.
  int decimals() const {
    constexpr int kMost = 9;
    const double size = has_interval() ? 10 * (high - low) : std::abs(value);
    if (size == 0) return 0;
    return std::clamp(2 - int(std::floor(std::log10(size))), 0, kMost);
  }
  std::string number(double x) const {
    const std::string text = fmt::format("{:.{}f}", x, decimals());
    const bool is_zero = text.find_first_not_of("-0.") == std::string::npos;
    const std::string plain = is_zero && text[0] == '-' ? text.substr(1) : text;
    if (has_interval() || plain.find('.') == std::string::npos) return plain;
    const std::size_t last = plain.find_last_not_of('0');  // 2.00 is 2 where no interval says how sure it is
    return plain.substr(0, plain[last] == '.' ? last : last + 1);
  }
  std::string with_unit(const std::string& text) const {
    return unit.empty() ? text : text + (unit == "°" ? "" : " ") + unit;
  }
  std::string with_interval() const {
    const std::string text = with_unit(number(value));
    return has_interval() ? fmt::format("{} ({} to {})", text, number(low), with_unit(number(high))) : text;
  }
  Quantity size() const { return value < 0 ? Quantity{-value, -high, -low, unit} : *this; }
};

Quantity quantity(const EffectInfo& info, const FoundParameter& found) {
  const std::string& unit = words_of(info, found.name).unit;
  const double factor = factor_of(parameter_of(info, found.name), unit);
  return {factor * found.value, factor * found.low, factor * found.high, unit};
}

/// Fills in the clauses of one sentence.
class Clauses {
 public:
  Clauses(const EffectInfo& info, const std::vector<FoundParameter>& found,
          const std::map<std::string, std::string>& facts)
      : info_(info), found_(found), facts_(facts) {}

  std::string filled(const std::string& clause) const {
    std::string text;
    for (std::size_t at = 0; at < clause.size();) {
      const std::size_t open = clause.find('[', at);
      text += with_values(clause.substr(at, open - at)).text;
      if (open == std::string::npos) break;
      const std::size_t close = clause.find(']', open);
      const Filled inner = with_values(clause.substr(open + 1, close - open - 1));
      if (inner.known) text += inner.text;
      at = close + 1;
    }
    return text;
  }

 private:
  struct Filled {
    std::string text;
    bool known = true;  ///< every fact is, and no parameter is neutral
  };

  Filled with_values(const std::string& part) const {
    Filled filled;
    for (std::size_t at = 0; at < part.size();) {
      const std::size_t open = part.find('{', at);
      filled.text += part.substr(at, open - at);
      if (open == std::string::npos) break;
      const std::size_t close = part.find('}', open);
      fill(part.substr(open + 1, close - open - 1), filled);
      at = close + 1;
    }
    return filled;
  }

  void fill(const std::string& hole, Filled& filled) const {
    if (const auto fact = facts_.find(hole); fact != facts_.end() && !fact->second.empty()) {
      filled.text += fact->second;
      return;
    }
    const std::size_t from = hole.find_first_not_of("|~=");
    const std::string name = hole.substr(from, hole.find_first_of("|?", from) - from);
    const auto same = [&](const EffectParameter& p) { return p.name == name; };
    if (std::none_of(info_.parameters.begin(), info_.parameters.end(), same)) {
      filled.known = false;  // a fact
      return;
    }
    const FoundParameter found = of(name);
    filled.known = filled.known && !is_neutral(info_, found);
    filled.text += value_text(hole, quantity(info_, found));
  }

  static std::string value_text(const std::string& hole, const Quantity& q) {
    if (const std::size_t choice = hole.find('?'); choice != std::string::npos) {
      const std::size_t other = hole.find('|', choice);
      return q.value < 0 ? hole.substr(other + 1) : hole.substr(choice + 1, other - choice - 1);
    }
    switch (hole[0]) {
      case '|':
        return q.size().with_interval();
      case '~':
        return q.with_unit(q.number(q.value));
      case '=':
        return q.number(q.value);
      default:
        return q.with_interval();
    }
  }

  FoundParameter of(const std::string& name) const {
    for (const FoundParameter& f : found_) {
      if (f.name == name) return f;
    }
    const double neutral = parameter_of(info_, name).neutral;
    return {name, neutral, neutral, neutral};
  }

  const EffectInfo& info_;
  const std::vector<FoundParameter>& found_;
  const std::map<std::string, std::string>& facts_;
};

}  // namespace

const EffectWords& words_of(const EffectInfo& info) {
  for (const EffectWords& w : words()) {
    if (w.effect == info.name) return w;
  }
  throw std::logic_error("no words for " + info.name);
}

bool is_neutral(const EffectInfo& info, const FoundParameter& found) {
  return found.value == parameter_of(info, found.name).neutral;
}

std::string shown(const EffectInfo& info, const FoundParameter& found) {
  const std::string& label = words_of(info, found.name).label;
  const std::string value = quantity(info, found).with_interval();
  return label.empty() ? value : label + " " + value;
}

std::string found_sentence(const EffectInfo& info, const std::vector<FoundParameter>& found,
                           const std::map<std::string, std::string>& facts) {
  const Clauses clauses(info, found, facts);
  std::string text;
  for (const std::string& clause : words_of(info).sentence) {
    const std::string filled = clauses.filled(clause);
    if (!filled.empty()) text += (text.empty() ? "" : " and ") + filled;
  }
  return text.empty() ? "the cause is " + words_of(info).noun : text;
}

}  // namespace umbsim
