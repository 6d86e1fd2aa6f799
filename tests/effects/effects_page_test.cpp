// docs/effects.md names every effect, and its figures are those of a fresh run.
#include <fstream>
#include <iostream>

#include "tests/effects/drives.h"

namespace umbsim {
namespace {

// The page is rounded to 0.01 mm and 0.001 deg; compilers may differ in the last bits, which sliding wheels magnify.
constexpr double kRounding_mm = 0.015, kRounding_deg = 0.0015;

std::vector<std::string> lines() {
  std::ifstream page(std::string(UMBSIM_SOURCE_DIR) + "/docs/effects.md");
  std::vector<std::string> all;
  for (std::string line; std::getline(page, line);) all.push_back(line);
  return all;
}

// The row of the table of return errors.
std::string row(const std::string& effect) {
  for (const std::string& line : lines()) {
    if (line.rfind("| [" + effect + "](", 0) == 0) return line;
  }
  return "";
}

TEST(EffectsPage, NamesEveryEffectOnceInTheTableAndOnceAsAHeading) {
  const std::vector<std::string> all = lines();
  for (const EffectInfo& info : catalogue()) {
    EXPECT_FALSE(row(info.name).empty()) << info.name << " is missing; docs/make-effects.sh makes the page again";
    EXPECT_EQ(std::count(all.begin(), all.end(), "## " + info.name), 1) << info.name;
    EXPECT_TRUE(
        std::any_of(all.begin(), all.end(),
                    [&](const std::string& line) { return line.find(info.text.description) != std::string::npos; }))
        << info.name << ": the catalogue's description has changed";
  }
}

TEST(EffectsPage, FiguresAreThoseOfAFreshRun) {
  for (const char* name :
       {"wheel_radius_scale", "wheelbase", "load_shift", "backlash", "encoder_latency", "carpet_drift"}) {
    ReturnError cw, ccw;
    const std::string text = row(name);
    ASSERT_EQ(std::sscanf(text.substr(text.find(") |") + 1).c_str(), " | (%lf, %lf) %lf | (%lf, %lf) %lf |", &cw.x_m,
                          &cw.y_m, &cw.theta_rad, &ccw.x_m, &ccw.y_m, &ccw.theta_rad),
              6)
        << text;
    const ExperimentResult r = run_experiment(testing::shipped(std::string("effects/") + name), 1);
    for (const auto& [page, run] : {std::pair{cw, r.cw}, {ccw, r.ccw}}) {
      EXPECT_NEAR(page.x_m, 1000 * run.centroid_x_m, kRounding_mm) << name;
      EXPECT_NEAR(page.y_m, 1000 * run.centroid_y_m, kRounding_mm) << name;
      EXPECT_NEAR(page.theta_rad, degrees(run.heading_rad), kRounding_deg) << name;
    }
  }
}

}  // namespace
}  // namespace umbsim
