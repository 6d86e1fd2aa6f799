#include <fmt/format.h>

#include <cmath>

#include "experiment/robot/understood.h"

namespace umbsim {
namespace {

double mm(double metres) { return 1e3 * metres; }

std::string limit(double value, const char* unit) {
  return std::isfinite(value) ? fmt::format("{:.3g} {}", value, unit) : std::string("none");
}

std::string spring(const Suspension& s) {
  if (!s.sprung()) return "";
  return fmt::format(", on a spring ({:.1f} mm up, {:.1f} mm down, {:.3g} N/m)", mm(s.up_m), mm(s.down_m),
                     s.stiffness_npm);
}

std::string caster_line(const Caster& c, double load_n) {
  std::string text = fmt::format("  caster '{}': ", c.link);
  if (c.swivels) {
    const double trail_m = (c.swivel_point_m - c.centre_m).head<2>().norm();
    text += fmt::format("a swivelling wheel of radius {:.1f} mm, trail {:.1f} mm", mm(c.radius_m), mm(trail_m));
  } else {
    text += fmt::format("a ball of radius {:.1f} mm", mm(c.radius_m));
  }
  return text + fmt::format(", at x {:.1f} mm, y {:.1f} mm, carries {:.2f} N{}\n", mm(c.centre_m.x()),
                            mm(c.centre_m.y()), load_n, spring(c.suspension));
}

std::string wheel_line(const Wheel& w, const char* side, double load_n) {
  const std::string effort = w.effort_limit_nm > 0 ? fmt::format(", at most {:g} N m", w.effort_limit_nm) : "";
  return fmt::format("  {} wheel '{}': radius {:.2f} mm, width {:.1f} mm, {:.3g} kg{}, carries {:.2f} N{}\n", side,
                     w.joint, mm(w.radius_m), mm(w.width_m), w.mass_kg, effort, load_n, spring(w.suspension));
}

std::string limits_line(const char* what, const AccelerationLimits& l) {
  return fmt::format("  {} above {} speeding up, {} braking, {} turning on the spot\n", what,
                     limit(l.forward_mps2, "m/s^2"), limit(l.backward_mps2, "m/s^2"),
                     limit(l.turning_radps2, "rad/s^2"));
}

std::string remark_lines(const UnderstoodRobot& u, Remark::Kind kind, const char* heading) {
  std::string text;
  for (const Remark& r : u.remarks) {
    if (r.kind == kind) text += fmt::format("  {}\n", r.text);
  }
  return text.empty() ? "" : fmt::format("{}\n{}", heading, text);
}

}  // namespace

std::string understood_text(const UnderstoodRobot& u) {
  const RobotModel& r = u.robot;
  std::string text =
      fmt::format("Robot {} ({}): a differential drive on {} supports\n", r.name, r.urdf, u.loads_n.size());
  text += fmt::format(
      "  {:.3f} kg, centre of mass {:.1f} mm ahead of the axle, {:.1f} mm left, {:.1f} mm above the floor\n",
      u.body.mass_kg, mm(u.body.com_m.x()), mm(u.body.com_m.y()), mm(u.body.com_m.z() + r.wheels[0].radius_m));
  text += fmt::format("Drive wheels: track {:.2f} mm\n", mm(r.wheelbase_m()));
  for (int i = 0; i < 2; ++i) text += wheel_line(r.wheels[i], i == 0 ? "left" : "right", u.loads_n[i]);
  text += fmt::format("Casters: {}\n", r.casters.size());
  for (std::size_t i = 0; i < r.casters.size(); ++i) text += caster_line(r.casters[i], u.loads_n[i + 2]);
  text += fmt::format("Accelerations on a floor of friction {:g}\n", u.friction);
  text += limits_line("tips over", u.tips) + limits_line("wheels slip", u.slips);
  text += remark_lines(u, Remark::Kind::understood, "Understood");
  text += remark_lines(u, Remark::Kind::assumed, "Assumed");
  text += remark_lines(u, Remark::Kind::ignored, "Ignored");
  if (u.wrong.empty()) return text + "Nothing is wrong with it.\n";
  text += "Wrong\n";
  for (const std::string& wrong : u.wrong) text += fmt::format("  {}\n", wrong);
  return text;
}

}  // namespace umbsim
