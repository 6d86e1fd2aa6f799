#pragma once

// What mutated code calls instead of an operator, a number or a function: the same, unless the environment's
// UMBSIM_MUTANT names this place. All mutants are in one program, which is compiled once. Written for ./run.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <set>
#include <type_traits>

namespace umbsim::mutation {

// The places that were passed, written to the file UMBSIM_MUTANTS_SEEN at the end.
struct Seen {
  std::set<int> places;
  ~Seen() {
    const char* name = std::getenv("UMBSIM_MUTANTS_SEEN");
    std::FILE* out = name ? std::fopen(name, "a") : nullptr;
    if (!out) return;
    for (const int place : places) std::fprintf(out, "%d\n", place);
    std::fclose(out);
  }
};

inline bool on(int place) {
  static const int chosen = std::getenv("UMBSIM_MUTANT") ? std::atoi(std::getenv("UMBSIM_MUTANT")) : 0;
  static Seen seen;
  if (chosen == 0) seen.places.insert(place);
  return chosen == place;
}

template <class T>
constexpr bool is_number = std::is_arithmetic_v<std::decay_t<T>>;

[[noreturn]] inline void not_here() {
  std::fputs("this mutant means nothing for these types\n", stderr);
  std::_Exit(77);
}

// a + b is written a + Plus{17} + b: its left half waits for b, and the precedence stays.
#define UMBSIM_MUTANT_OPERATOR(NAME, OP, USUAL, OTHER)                  \
  struct NAME {                                                         \
    int place;                                                          \
  };                                                                    \
  template <class A>                                                    \
  struct Left##NAME {                                                   \
    const A& a;                                                         \
    int place;                                                          \
  };                                                                    \
  template <class A>                                                    \
  Left##NAME<A> operator OP(const A& a, NAME m) {                       \
    return {a, m.place};                                                \
  }                                                                     \
  template <class A, class B>                                           \
  auto operator OP(Left##NAME<A> left, const B& b) {                    \
    const bool other = on(left.place);                                  \
    if constexpr (is_number<A> && is_number<B>) {                       \
      return other ? left.a OTHER b : left.a USUAL b;                   \
    } else {                                                            \
      if (other) not_here();                                            \
      return left.a USUAL b;                                            \
    }                                                                   \
  }
UMBSIM_MUTANT_OPERATOR(Plus, +, +, -)
UMBSIM_MUTANT_OPERATOR(Minus, -, -, +)
UMBSIM_MUTANT_OPERATOR(Times, *, *, /)
UMBSIM_MUTANT_OPERATOR(Over, /, /, *)
UMBSIM_MUTANT_OPERATOR(Less, <, <, <=)
UMBSIM_MUTANT_OPERATOR(AtMost, <=, <=, <)
UMBSIM_MUTANT_OPERATOR(More, >, >, >=)
UMBSIM_MUTANT_OPERATOR(AtLeast, >=, >=, >)
UMBSIM_MUTANT_OPERATOR(Same, ==, ==, !=)
UMBSIM_MUTANT_OPERATOR(Differs, !=, !=, ==)
#undef UMBSIM_MUTANT_OPERATOR

template <class T>
T number(int place, T x) {
  return on(place) ? T(x + 1) : x;
}
inline int minus(int place) { return on(place) ? 1 : -1; }
inline bool keep(int place) { return !on(place); }
inline bool branch(int always, int never, bool condition) { return on(always) || (!on(never) && condition); }
inline double sin(int place, double x) { return on(place) ? std::cos(x) : std::sin(x); }
inline double cos(int place, double x) { return on(place) ? std::sin(x) : std::cos(x); }
inline double sqrt(int place, double x) { return on(place) ? x : std::sqrt(x); }
template <class T>
T abs(int place, T x) {
  return on(place) ? x : std::abs(x);
}
template <class T>
T min(int place, T a, T b) {
  return on(place) ? std::max(a, b) : std::min(a, b);
}
template <class T>
T max(int place, T a, T b) {
  return on(place) ? std::min(a, b) : std::max(a, b);
}

}  // namespace umbsim::mutation
