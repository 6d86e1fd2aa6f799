#include <fmt/format.h>

#include <map>

#include "core/text/yaml_text.h"
#include "experiment/scenario/read_course.h"
#include "experiment/scenario/scenario.h"

namespace umbsim {
namespace {

std::string optional_line(const char* key, const std::optional<double>& value) {
  return value ? fmt::format("  {}: {}\n", key, *value) : std::string();
}

std::string odometry_block(const OdometryChoice& o) {
  const std::string lines =
      optional_line("left_radius_m", o.left_radius_m) + optional_line("right_radius_m", o.right_radius_m) +
      optional_line("wheelbase_m", o.wheelbase_m) + (o.scrub > 0 ? fmt::format("  scrub: {}\n", o.scrub) : "");
  return lines.empty() ? "odometry: {}  # the URDF's nominal dimensions\n" : "odometry:\n" + lines;
}

std::string bumps_block(const BumpChoice& b) {
  std::string text = fmt::format("bumps:\n  wheel: {}\n  leg: {}\n  count: {}\n  height_m: {}\n", name(b.laid.wheel),
                                 b.laid.leg, b.laid.count, b.laid.height_m);
  if (b.fixed.empty()) return text + "  cables: []\n";
  text += "  cables:\n";
  for (const Cable& c : b.fixed) {
    text += fmt::format("    - {{x_m: {}, y_m: {}, height_m: {}, direction_rad: {}, length_m: {}}}\n", c.x_m, c.y_m,
                        c.height_m, c.direction_rad, c.length_m);
  }
  return text;
}

// Like cables: what is off is left out.
std::string uncertainty_block(const Scenario& s) {
  std::string text;
  if (s.uncertainty.any()) {
    text += fmt::format("uncertainty:\n  left_m_per_sqrt_m: {}\n  right_m_per_sqrt_m: {}\n",
                        s.uncertainty.left_m_per_sqrt_m, s.uncertainty.right_m_per_sqrt_m);
  }
  if (s.fixes.empty()) return text;
  text += "fixes:\n";
  for (const AbsoluteFix& fix : s.fixes) {
    text += fmt::format("  - {{leg: {}, position_sd_m: {}, heading_sd_rad: {}}}\n", fix.leg, fix.noise.position_sd_m,
                        fix.noise.heading_sd_rad);
  }
  return text;
}

std::string effects_block(const std::vector<Effect>& effects) {
  if (effects.empty()) return "effects: {}\n";
  std::string text = "effects:\n";
  for (const Effect& effect : effects) {
    text += fmt::format("  {}:\n", effect.info->name);
    for (std::size_t i = 0; i < effect.values.numbers.size(); ++i) {
      text += fmt::format("    {}: {}\n", effect.info->parameters[i].name, effect.values.numbers[i]);
    }
    if (effect.info->one_run) text += fmt::format("    run: {}\n", yaml_string(effect.values.run));
  }
  return text;
}

std::string expect_block(const std::vector<Expectation>& expectations) {
  std::map<std::string, std::string> by_figure;
  for (const Expectation& e : expectations) {
    std::string& items = by_figure[e.figure];
    items += (items.empty() ? "{" : ", {") + bounds_text(e, ": ", ", ") + "}";
  }
  std::string text = by_figure.empty() ? "" : "expect:\n";
  for (const auto& [figure, items] : by_figure) text += fmt::format("  {}: [{}]\n", figure, items);
  return text;
}

std::string runs_block(const RunChoice& r) {
  std::string directions;
  for (const Direction d : r.directions) directions += (directions.empty() ? "" : ", ") + std::string(name(d));
  return fmt::format("runs:\n  directions: [{}]\n  per_direction: {}\n  start_heading_rad: {}\n", directions,
                     r.per_direction, r.start_heading_rad);
}

// What is left to the URDF is left out.
std::string suspension_block(const SuspensionChoice& s) {
  std::string text;
  const auto add = [&](const char* key, double value) {
    text += fmt::format("{}{}: {}", text.empty() ? "" : ", ", key, value);
  };
  if (s.wheel_travel_m) add("wheel_travel_m", *s.wheel_travel_m);
  if (s.caster_travel_m) add("caster_travel_m", *s.caster_travel_m);
  if (s.damping_ratio != SuspensionChoice{}.damping_ratio) add("damping_ratio", s.damping_ratio);
  return text.empty() ? "" : "  suspension: {" + text + "}\n";
}

std::string robot_block(const RobotChoice& r) {
  std::string text = fmt::format(
      "robot:\n  urdf: {}\n  left_joint: {}\n  right_joint: {}\n  caster_friction: {}\n  torque_limit_nm: {}\n",
      yaml_string(r.urdf), yaml_string(r.joints.left), yaml_string(r.joints.right), r.caster_friction,
      r.torque_limit_nm);
  if (r.wheel_size.radius_m > 0) text += fmt::format("  wheel_radius_m: {}\n", r.wheel_size.radius_m);
  if (r.wheel_size.width_m > 0) text += fmt::format("  wheel_width_m: {}\n", r.wheel_size.width_m);
  return text + suspension_block(r.suspension);
}

}  // namespace

std::string resolved_yaml(const Scenario& s) {
  std::string text = "format: umbsim-scenario/1\n";
  text += fmt::format("name: {}\ndescription: {}\nseed: {}\n", yaml_string(s.name), yaml_string(s.description), s.seed);
  text += robot_block(s.robot);
  text += fmt::format("encoders:\n  ticks_per_revolution: {}\n  rate_hz: {}\n", s.encoders.ticks_per_revolution,
                      s.encoders.rate_hz);
  text += fmt::format("floor:\n  friction: {}\n", s.floor_friction);
  text += course_block(s.course) + runs_block(s.runs);
  text += s.bumps.any() ? bumps_block(s.bumps) : "";
  text += fmt::format("noise:\n  floor_rms_m: {}\n  floor_wavelength_m: {}\n  radius_scatter: {}\n",
                      s.noise.floor_rms_m, s.noise.floor_wavelength_m, s.noise.radius_scatter);
  if (s.noise.motor_scatter > 0) text += fmt::format("  motor_scatter: {}\n", s.noise.motor_scatter);
  if (s.noise.wheel_noise_m_per_sqrt_m > 0) {
    text += fmt::format("  wheel_noise_m_per_sqrt_m: {}\n", s.noise.wheel_noise_m_per_sqrt_m);
  }
  text += fmt::format("truth:\n  kind: {}\n  rate_hz: {}\n  position_sd_m: {}\n  heading_sd_rad: {}\n", s.truth.kind,
                      s.truth.rate_hz, s.truth.position_sd_m, s.truth.heading_sd_rad);
  text += odometry_block(s.odometry) + uncertainty_block(s);
  text += fmt::format("calibration:\n  method: {}\n  max_passes: {}\n", name(s.calibration.method),
                      s.calibration.max_passes);
  text += fmt::format(
      "physics:\n  step_s: {}\n  fine_step_s: {}\n  gravity_mps2: {}\n  static_sink_m: {}\n  damping_ratio: {}\n",
      s.physics.step_s, s.physics.fine_step_s, s.physics.gravity_mps2, s.physics.softness.static_sink_m,
      s.physics.softness.damping_ratio);
  return text + effects_block(s.effects) + expect_block(s.expect);
}

}  // namespace umbsim
