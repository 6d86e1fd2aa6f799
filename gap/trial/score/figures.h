#pragma once

#include <string>
#include <vector>

#include "gap/trial/score/statistics.h"
#include "gap/trial/score/verdict.h"

namespace umbsim {

/// One line of the table of figures.
struct Figure {
  std::string key;     ///< in summary.json
  std::string text;
  std::string unit;    ///< "share", "ratio", "s", "effects"
  Estimate estimate;
  int hits = 0;        ///< of a share
  int cases = 0;       ///< that it is made from
  std::string bar;     ///< as text; empty: no bar
  enum class Met { no_bar, no_cases, yes, no } met = Met::no_bar;
};
const char* name(Figure::Met met);

/// Cases of a single effect that can be detected: what most figures are made from.
bool single_and_detectable(const Verdict& v);

/// The table of GAP figures, in its order, with the bars of a trial on the same simulator.
std::vector<Figure> figures(const std::vector<Verdict>& verdicts);

}  // namespace umbsim
