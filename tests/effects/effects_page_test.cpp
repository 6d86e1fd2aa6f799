// docs/effects.md names every effect, and its figures are those of a fresh run.
#include <fstream>
#include <iostream>
#include <map>

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

// Of a row, in mm and degrees.
struct Row {
  ReturnError cw, ccw, cw_closed_form, ccw_closed_form;
  int numbers = 0;  ///< 12, or 6 where there is no closed form
};

Row numbers(const std::string& row) {
  Row r;
  const auto* text = row.c_str() + row.find(") |") + 1;
  ReturnError *a = &r.cw, *b = &r.ccw, *c = &r.cw_closed_form, *d = &r.ccw_closed_form;
  r.numbers = std::sscanf(text, " | (%lf, %lf) %lf | (%lf, %lf) %lf | (%lf, %lf) %lf | (%lf, %lf) %lf |", &a->x_m,
                          &a->y_m, &a->theta_rad, &b->x_m, &b->y_m, &b->theta_rad, &c->x_m, &c->y_m, &c->theta_rad,
                          &d->x_m, &d->y_m, &d->theta_rad);
  return r;
}

// Terms of higher order, and what a closed form leaves out: the sink of a soft support under a cable; the sway of an
// axle on an eccentric wheel.
TEST(EffectsPage, FiguresAreThoseOfTheClosedForms) {
  constexpr double kRelative = 0.03, kSmall_mm = 0.2, kSmall_deg = 0.006;
  const std::map<std::string, double> left_out_mm{
      {"bump", 0.8}, {"wheel_eccentricity", 1.0}, {"encoder_missed_counts", 3}};
  int compared = 0;
  for (const EffectInfo& info : catalogue()) {
    const Row r = numbers(row(info.name));
    if (r.numbers == 6) continue;
    ASSERT_EQ(r.numbers, 12) << row(info.name);
    ++compared;
    const double small_mm = left_out_mm.count(info.name) ? left_out_mm.at(info.name) : kSmall_mm;
    for (const auto& [a, b] : {std::pair{r.cw, r.cw_closed_form}, {r.ccw, r.ccw_closed_form}}) {
      const double off_mm = std::hypot(a.x_m - b.x_m, a.y_m - b.y_m), size_mm = std::hypot(b.x_m, b.y_m);
      EXPECT_LT(off_mm, kRelative * size_mm + small_mm) << info.name;
      EXPECT_NEAR(a.theta_rad, b.theta_rad, kRelative * std::abs(b.theta_rad) + kSmall_deg) << info.name;
    }
  }
  EXPECT_GE(compared, 19);
}

TEST(EffectsPage, FiguresAreThoseOfAFreshRun) {
  for (const char* name : {"wheel_radius_scale", "wheel_radius_difference", "wheelbase", "wheel_misalignment",
                           "wheel_eccentricity", "load_shift", "backlash", "encoder_latency", "tyre_compliance",
                           "contact_patch", "caster_drag", "bump", "floor_slope", "carpet_drift"}) {
    const Row shown = numbers(row(name));
    const ReturnError &cw = shown.cw, &ccw = shown.ccw;
    ASSERT_GE(shown.numbers, 6) << row(name);
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
