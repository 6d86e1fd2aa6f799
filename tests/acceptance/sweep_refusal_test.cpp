// Bad sweeps: one clear message that names file, line, key, value and bound; exit code 2; nothing written.
#include "tests/acceptance/sweep_program.h"

namespace umbsim::acceptance {
namespace {

struct BadSweep {
  const char* what;
  const char* rest;  ///< after the format and the scenario, so it begins on line 3
  std::vector<std::string> says;
};

const BadSweep kBadSweeps[] = {
    {"UnknownKey", "axis: {seed: [1]}\naxes: {seed: [1]}\n", {"bad.yaml:3:1: ", "axis", "did you mean 'axes'?"}},
    {"NoAxes", "replicates: 2\n", {"axes", "missing"}},
    {"UnknownParameter", "axes:\n  course.side: [1, 2]\n", {"bad.yaml:4:", "course.side", "did you mean 'side_m'?"}},
    {"UnknownEffect", "axes:\n  effects.wheelbas.relative: [0]\n", {"bad.yaml:4:", "did you mean 'wheelbase'?"}},
    {"ValueOutOfRange",
     "axes:\n  course.side_m: [1, 2000]\n",
     {"bad.yaml:4:", "course.side_m", "value 2000", "must be > 0 and <= 1000"}},
    {"RangeOutOfRange",
     "axes:\n  effects.wheelbase.relative: {from: 0, to: 2, count: 3}\n",
     {"bad.yaml:4:", "effects.wheelbase.relative", "value 1", "must be >= -0.5 and <= 0.5"}},
    {"ValuesThatDoNotFitTogether",
     "set: {course.turn: arc, course.turn_radius_m: 0.1, course.side_m: 1}\naxes:\n  course.turn_radius_m: [0.1, "
     "0.2]\n  course.side_m: [0.3, 1]\n",
     {"bad.yaml:5:", "point 2", "turn_radius_m: 0.2", "side_m = 0.3"}},
    {"UnknownChoice",
     "axes:\n  calibration.method: [heading, guess]\n",
     {"bad.yaml:4:", "'guess'", "none, endpoint, heading"}},
    {"NoSuchRobot", "axes:\n  robot: [labmate.urdf, nobody.urdf]\n", {"bad.yaml:4:", "value nobody.urdf"}},
    {"SameValueTwice", "axes:\n  seed: [1, 2, 1]\n", {"bad.yaml:4:16: ", "'1' is given twice"}},
    {"EmptyList", "axes:\n  seed: []\n", {"bad.yaml:4:9: ", "at least one value"}},
    {"NeitherListNorRange", "axes:\n  seed: 3\n", {"bad.yaml:4:9: ", "expected a list"}},
    {"RangeWithoutCount", "axes:\n  course.side_m: {from: 1, to: 2}\n", {"bad.yaml:4:", "count or step"}},
    {"CountAndStep",
     "axes:\n  course.side_m: {from: 1, to: 2, count: 2, step: 1}\n",
     {"bad.yaml:4:", "both count and step"}},
    {"RangeBackwards",
     "axes:\n  course.side_m: {from: 2, to: 1, count: 2}\n",
     {"bad.yaml:4:", "1 is out of range (must be >= from = 2)"}},
    {"LogFromZero",
     "axes:\n  course.side_m: {from: 0, to: 1, count: 2, scale: log}\n",
     {"bad.yaml:4:", "must be > 0 with scale: log"}},
    {"StepZero", "axes:\n  course.side_m: {from: 0, to: 1, step: 0}\n", {"bad.yaml:4:", "step", "must be > 0"}},
    {"SamplesMissing", "design: sobol\naxes:\n  course.side_m: {from: 1, to: 2}\n", {"samples", "missing"}},
    {"NothingToSample",
     "design: sobol\nsamples: 4\naxes:\n  course.side_m: [1, 2]\n",
     {"bad.yaml:", "at least one range"}},
    {"CountInASampledDesign",
     "design: latin_hypercube\nsamples: 4\naxes:\n  course.side_m: {from: 1, to: 2, count: 3}\n",
     {"bad.yaml:6:", "count", "no meaning"}},
    {"ReplicatesOfSeeds", "replicates: 2\naxes:\n  seed: [1, 2]\n", {"bad.yaml:5:", "seed"}},
    {"TooManyPoints",
     "replicates: 1000000\naxes:\n  course.side_m: {from: 1, to: 2, count: 1000000}\n",
     {"bad.yaml", "must be <= 100000000"}},
    {"PointWithoutAKey",
     "design: list\npoints:\n  - {course.side_m: 1, seed: 2}\n  - {course.side_m: 1}\n",
     {"bad.yaml:6:", "seed", "missing"}},
    {"BadSet",
     "set: {course.side_m: -1}\naxes: {seed: [1]}\n",
     {"bad.yaml:3:6: ", "course.side_m", "-1", "must be > 0"}},
    {"UnknownFigure",
     "axes: {seed: [1]}\nexpect: {recovery.e_d_eror: {max: 1}}\n",
     {"bad.yaml:4:", "did you mean 'recovery.e_d_error'?"}},
    {"NoBound", "axes: {seed: [1]}\nexpect: {recovery.e_d_error: {}}\n", {"bad.yaml:4:", "min, max or abs_max"}},
    {"QuantileOutOfRange",
     "axes: {seed: [1]}\nexpect: {recovery.e_d_error: {max: 1, quantile: 95}}\n",
     {"bad.yaml:4:", "quantile", "95", "must be >= 0 and <= 1"}},
    {"BadCondition",
     "axes: {seed: [1]}\nexpect: {recovery.e_d_error: {max: 1, where: seed}}\n",
     {"bad.yaml:4:", "'seed'", "key op value"}},
    {"ConditionOnNothing",
     "axes: {seed: [1]}\nexpect: {recovery.e_d_error: {max: 1, where: sed = 1}}\n",
     {"bad.yaml:4:", "'sed'", "did you mean 'seed'?"}},
    {"ReportOverNoAxis", "axes: {seed: [1]}\nreport: {x: course.side_m}\n", {"bad.yaml:4:", "'course.side_m'", "seed"}},
};

class Refused : public testing::TestWithParam<BadSweep> {};

TEST_P(Refused, WithAMessageAndNothingWritten) {
  const Desk desk;
  desk.put("tiny.yaml", kTinyScenario);
  desk.put("bad.yaml", std::string("format: umbsim-sweep/1\nscenario: tiny.yaml\n") + GetParam().rest);
  const std::set<std::string> before = listing(desk.home);
  const Outcome outcome = desk.umbsim({"sweep", "bad.yaml"});
  EXPECT_EQ(outcome.code, 2) << outcome.out << outcome.err;
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  expect_says(outcome.err, GetParam().says);
  expect_says(outcome.err, {"bad.yaml"});
  EXPECT_EQ(listing(desk.home), before) << "something was left behind";
}

INSTANTIATE_TEST_SUITE_P(Sweep, Refused, testing::ValuesIn(kBadSweeps),
                         [](const auto& bad) { return std::string(bad.param.what); });

TEST(RefusedOptions, AreNamed) {
  const Desk desk;
  desk.put("tiny.yaml", kTinyScenario);
  desk.put("s.yaml", tiny_sweep(2));
  const std::pair<std::vector<std::string>, std::string> kWrong[] = {
      {{"sweep", "s.yaml", "--shard", "5/4"}, "--shard 5/4: i = 5 is out of range (must be >= 1 and <= 4)"},
      {{"sweep", "s.yaml", "--axis", "seed"}, "--axis seed: must have the form"},
      {{"sweep", "s.yaml", "--axis", "course.side_m=[-1]"}, "must be > 0"},
      {{"sweep", "s.yaml", "--set", "course.side_m=-1"}, "must be > 0"},
      {{"sweep", "nothing.yaml"}, "nothing.yaml: cannot be read"},
      {{"sweep"}, "a sweep file is missing"},
      {{"sweep", "merge", "s.yaml"}, "holds no shard-i-of-n.sqlite"},
      {{"sweep", "export", "nowhere"}, "nowhere: there is no such file"},
  };
  const std::set<std::string> before = listing(desk.home);
  for (const auto& [words, says] : kWrong) {
    const Outcome outcome = desk.umbsim(words);
    EXPECT_EQ(outcome.code, 2) << outcome.err;
    expect_says(outcome.err, {says});
    EXPECT_EQ(listing(desk.home), before);
  }
}

TEST(RefusedOptions, ASweepIsNoScenarioForRun) {
  const Desk desk;
  desk.put("tiny.yaml", kTinyScenario);
  desk.put("s.yaml", tiny_sweep(2));
  EXPECT_EQ(desk.umbsim({"run", "s.yaml"}).code, 2);
  EXPECT_EQ(desk.umbsim({"sweep", "tiny.yaml"}).code, 2);
}

}  // namespace
}  // namespace umbsim::acceptance
