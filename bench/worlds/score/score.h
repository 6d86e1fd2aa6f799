#pragma once

#include <map>
#include <string>
#include <vector>

#include "gap/trial/score/score.h"

namespace umbsim::worlds {

/// A diagnosed case with what only its world says of it.
struct WorldVerdict {
  Verdict verdict;
  std::string kind;                           ///< none | single | pair | triple | outside | excluded
  std::map<std::string, std::string> groups;  ///< engine, driver, tracker, runs, robot
  double unknown = 0;                         ///< how much the diagnosis leans to "unknown": its stated probability
  std::vector<double> not_there;              ///< noise floors that each named effect is worth that is not in the case
  double steps = 0;                           ///< of the engine, for the recording
  double of_the_world = 0;                    ///< noise floors that the world is off by with nothing wrong in it

  bool visible() const { return !verdict.answer.undetectable_expected; }
  /// At least one noise floor, and the diagnosis does not say that these runs mistake it for another effect.
  bool is_plain() const;
  bool known() const { return kind == "single" || kind == "pair" || kind == "triple"; }
  /// Every effect of the case is among those that the first cause names.
  bool all_named() const;
  bool names_more() const;  ///< something that is not there, worth over half a noise floor
  bool names_true() const;  ///< something that is there
  bool names_untrue() const { return !not_there.empty(); }  ///< something that is not, whatever it is worth
};

/// Figures of one group of cases.
struct WorldFigures {
  int cases = 0;
  int undetectable = 0;
  int failed = 0;
  Figure false_alarm;     ///< of cases without effect
  Figure pose_alarm;      ///< of those, something named that moves the robot by over half a noise floor
  Figure quiet_alarm;     ///< of cases without effect in worlds that are off by less than half a noise floor themselves
  Figure right;           ///< first cause exactly right, one effect that shows
  Figure plain;           ///< the same of effects that are plainly there (WorldVerdict::is_plain)
  Figure both;            ///< both of two effects named, and nothing else
  Figure named;           ///< truth among the named: one to three effects that show
  Figure in_set;          ///< truth in one member of the set: one to three effects that show
  Figure only_true;       ///< something true named and nothing untrue: one to three effects that show
  Figure not_there;       ///< something named that is not there and worth over half a noise floor
  Figure untrue;          ///< something named that is not there, whatever it is worth
  Figure closure;         ///< median, where an effect shows
  Figure closed;          ///< closure of at least 0.7, where an effect shows
  Figure misled;          ///< closure below 0, where an effect shows
  Figure covered;         ///< 95 % intervals of right causes that hold the truth, one effect that shows
  Figure calibration;     ///< stated probabilities of first causes against shares of right ones, mean by tenths
  Figure unknown_recall;  ///< unknown effects found where 5 % of the known ones are called so
  Figure unknown_area;    ///< area under that curve
  Figure wall_s;          ///< of a diagnosis, median
  Figure longest_s;       ///< of a diagnosis
};

WorldFigures world_figures(const std::vector<const WorldVerdict*>& verdicts);

/// Score of a folder: all, and by engine, effect, tracker, driver and set of runs.
struct WorldScore {
  std::string name;
  std::string answers_sha256;
  bool sealed = false;
  int not_diagnosed = 0;
  int worlds_redrawn = 0;  ///< worlds whose nominal robot could not drive, over all cases
  std::vector<WorldVerdict> verdicts;
  WorldFigures all;
  std::map<std::string, std::map<std::string, WorldFigures>> groups;  ///< by what, by which
  LeakFigure leak;                                                    ///< of the effect from the metadata
};

/// Throws InputError as score_trial does. Cases without a diagnosis are left out and counted.
WorldScore score_worlds(const TrialFolder& folder);

/// How far an effect that is named but not there moves the recorded robot in this simulator, in noise floors of the
/// diagnosis.
double worth(const std::filesystem::path& recording, const std::string& effect,
             const std::map<std::string, ParameterEstimate>& parameters, double noise_floor_mm);

Json score_json(const WorldScore& score);
std::string score_markdown(const WorldScore& score);

}  // namespace umbsim::worlds
