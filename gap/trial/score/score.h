#pragma once

#include <optional>
#include <string>
#include <vector>

#include "gap/trial/score/baselines.h"
#include "gap/trial/score/figures.h"
#include "gap/trial/score/leaks.h"
#include "gap/trial/score/tallies.h"
#include "gap/trial/write/trial_folder.h"

namespace umbsim {

/// A trial opened and compared: everything that is published of it.
struct TrialScore {
  std::string trial;
  bool sealed = false;        ///< the answers are those that were sealed before the diagnoses
  std::string answers_sha256;
  std::vector<Verdict> verdicts;  ///< by case name
  std::vector<Figure> figures;
  std::vector<Baseline> baselines;
  LeakFigure shuffled;        ///< of the single tier
  std::optional<LeakFigure> metadata;  ///< where the recordings are here; tiers with the whole set of runs
};

/// Opens the answers (default: the trial's own) and compares them with the diagnoses. Throws InputError if the answers
/// are not those whose hash was stored when the cases were diagnosed, a case has no answer, or no diagnosis stands.
TrialScore score_trial(const TrialFolder& folder, const std::filesystem::path& answers);

Json score_json(const TrialScore& score);            ///< summary.json
/// by_severity and calibration: the detection and the calibration curve.
Json curves_json(const std::vector<Verdict>& verdicts);
std::string confusion_csv(const Confusion& confusion);
std::string confusion_svg(const Confusion& confusion, const std::string& title);
std::string score_table(const TrialScore& score);    ///< for a terminal
std::string score_markdown(const TrialScore& score); ///< for a document
std::string undetected_table(const TrialScore& score);

}  // namespace umbsim
