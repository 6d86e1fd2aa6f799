// What every command prints fits a terminal of 80 columns, with long names too.
#include "core/text/wrapped_text.h"
#include "tests/acceptance/program.h"

namespace umbsim::acceptance {
namespace {

// Names as long as they come; folders are left out, for a path is not broken.
const char* kLong = R"(format: umbsim-scenario/1
description: A description that is as long as people write them when they have much to say about a scenario of theirs
seed: 7
robot: {urdf: labmate.urdf}
encoders: {ticks_per_revolution: 2000, rate_hz: 50}
course: {side_m: 0.5, linear_speed_mps: 0.5, angular_speed_radps: 1.5, linear_acceleration_mps2: 1, dwell_s: 0}
runs: {per_direction: 2}
noise: {floor_rms_m: 0.0005, radius_scatter: 0.0001}
truth: {position_sd_m: 0.002, heading_sd_rad: 0.007}
bumps: {wheel: inner, leg: 1, count: 2, height_m: 0.005}
uncertainty: {left_m_per_sqrt_m: 0.0002, right_m_per_sqrt_m: 0.0002}
effects:
  wheel_radius_difference: {relative: 0.004}
  encoder_missed_counts: {left_probability: 0.001}
expect:
  recovery.e_max_after_m: {max: 1}
  umbmark.endpoint.left_factor: {min: 0, max: 2}
)";

void expect_fits(const Outcome& outcome) {
  std::istringstream lines(outcome.out);
  std::string line;
  std::size_t most = 0;
  while (std::getline(lines, line)) {
    if (line.rfind("Result in ", 0) == 0) continue;
    most = std::max(most, columns_of(line));
    EXPECT_LE(columns_of(line), kColumns) << line;
  }
  EXPECT_GT(most, kColumns / 3) << outcome.out;
}

class TerminalWidth : public testing::Test {
 protected:
  void SetUp() override { desk.put("a_scenario_with_a_very_long_name_of_its_own_that_goes_on_and_on.yaml", kLong); }
  Outcome done(const std::vector<std::string>& words) const {
    const Outcome outcome = desk.umbsim(words);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return outcome;
  }
  const Desk desk;
  const std::string scenario = "a_scenario_with_a_very_long_name_of_its_own_that_goes_on_and_on.yaml";
};

TEST_F(TerminalWidth, RunCalibrateExplain) {
  expect_fits(done({"run", scenario, "--out", "r"}));
  expect_fits(done({"calibrate", "r", "--out", "c"}));
  expect_fits(done({"explain", scenario}));
  expect_fits(done({"effects"}));
  for (const char* effect : {"push", "wheel_radius_scale", "encoder_missed_counts", "contact_patch"}) {
    expect_fits(done({"effects", effect}));
  }
}

TEST_F(TerminalWidth, Sweep) {
  desk.put("sweep_with_a_name_that_is_longer_than_most.yaml",
           "format: umbsim-sweep/1\nscenario: " + scenario +
               "\naxes:\n  effects.wheel_radius_difference.relative: [0.001, 0.002]\n  "
               "effects.encoder_missed_counts.left_probability: [0.001, 0.002]\nexpect:\n  "
               "recovery.e_max_after_m: {max: 1}\n");
  expect_fits(done({"sweep", "sweep_with_a_name_that_is_longer_than_most.yaml", "--out", "s"}));
}

TEST_F(TerminalWidth, DiagnosePredictPlan) {
  done({"run", scenario, "--out", "r", "--set", "bumps.count=0"});
  expect_fits(done({"gap", "diagnose", "r", "--out", "d", "--no-cache"}));
  expect_fits(done({"gap", "predict", "r", "--scenario", "d/twin.yaml", "--squares", "r", "--out", "p"}));
  for (const char* matrix : {"--matrix", "--no-cache"}) {
    expect_fits(done({"gap", "plan", scenario, "--out", "n", "--force", "--draws", "20", "--effects",
                      "wheelbase,wheel_radius_difference,encoder_missed_counts,tyre_compliance,wheel_misalignment,"
                      "contact_patch,wheel_radius_scale,carpet_drift,backlash,encoder_latency,wear",
                      matrix}));
  }
}

}  // namespace
}  // namespace umbsim::acceptance
