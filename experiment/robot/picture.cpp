#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "experiment/robot/understood.h"

namespace umbsim {
namespace {

using Eigen::Vector3d;

constexpr double kView_px = 380, kMargin_px = 60, kTop_px = 70;
constexpr double kCasterWidth_radii = 0.5;

struct View {
  double left_px, top_px;  // of its middle
  double scale_pxpm;
  Vector3d middle_m;
  bool from_above;

  // x ahead is to the right; above it y to the left of the robot is up, from the side z is up.
  double u(const Vector3d& p) const { return left_px + scale_pxpm * (p.x() - middle_m.x()); }
  double v(const Vector3d& p) const {
    return top_px - scale_pxpm * (from_above ? p.y() - middle_m.y() : p.z() - middle_m.z());
  }
  std::string circle(const Vector3d& p, double radius_m, const char* style) const {
    return fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:.1f}\" {}/>\n", u(p), v(p), scale_pxpm * radius_m,
                       style);
  }
  std::string box(const Vector3d& p, double ahead_m, double across_m, const char* style) const {
    const double w = scale_pxpm * ahead_m, h = std::max(2.0, scale_pxpm * across_m);
    return fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" {}/>\n", u(p) - w / 2,
                       v(p) - h / 2, w, h, style);
  }
  std::string line(const Vector3d& a, const Vector3d& b, const char* style) const {
    return fmt::format("<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" {}/>\n", u(a), v(a), u(b), v(b),
                       style);
  }
};

constexpr const char* kWheel = "fill=\"#4477aa\" fill-opacity=\"0.6\" stroke=\"#223355\"";
constexpr const char* kCaster = "fill=\"#ccbb44\" fill-opacity=\"0.7\" stroke=\"#776611\"";
constexpr const char* kThin = "stroke=\"#888888\" stroke-dasharray=\"4 3\"";

std::string text_at(double x, double y, const std::string& text, const char* style = "") {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" {}>{}</text>\n", x, y, style, text);
}

std::string cross(const View& view, const Vector3d& p) {
  const double x = view.u(p), y = view.v(p);
  return fmt::format("<path d=\"M{:.1f} {:.1f}h16M{:.1f} {:.1f}v16\" stroke=\"#cc3311\" stroke-width=\"2\"/>\n", x - 8,
                     y, x, y - 8) +
         text_at(x + 6, y - 8, "centre of mass", "fill=\"#cc3311\"");
}

std::string loads(const View& view, const UnderstoodRobot& u) {
  std::string svg;
  const auto add = [&](const Vector3d& at, double below_m, double load_n) {
    svg += text_at(view.u(at), view.v(at) + view.scale_pxpm * below_m + 13, fmt::format("{:.1f} N", load_n),
                   "text-anchor=\"middle\"");
  };
  for (int i = 0; i < 2; ++i) add(u.robot.wheels[i].centre_m, u.robot.wheels[i].width_m / 2, u.loads_n[i]);
  for (std::size_t i = 0; i < u.robot.casters.size(); ++i) {
    add(u.robot.casters[i].centre_m, u.robot.casters[i].radius_m, u.loads_n[i + 2]);
  }
  return svg;
}

std::string supports(const View& view, const RobotModel& r) {
  std::string svg;
  for (const Caster& c : r.casters) {
    const bool wheel = c.swivels && view.from_above;
    svg += wheel ? view.box(c.centre_m, 2 * c.radius_m, kCasterWidth_radii * c.radius_m, kCaster)
                 : view.circle(c.centre_m, c.radius_m, kCaster);
    if (c.swivels && view.from_above) svg += view.circle(c.swivel_point_m, 0.15 * c.radius_m, "fill=\"#776611\"");
  }
  for (const Wheel& w : r.wheels) {
    svg += view.from_above ? view.box(w.centre_m, 2 * w.radius_m, w.width_m, kWheel)
                           : view.circle(w.centre_m, w.radius_m, kWheel);
  }
  return svg;
}

// Half the extent of what is drawn, and its middle.
std::pair<Vector3d, Vector3d> extent(const UnderstoodRobot& u) {
  Vector3d low = u.body.com_m, high = low;
  const auto add = [&](const Vector3d& p, double r) {
    low = low.cwiseMin(p - Vector3d::Constant(r));
    high = high.cwiseMax(p + Vector3d::Constant(r));
  };
  for (const Wheel& w : u.robot.wheels) add(w.centre_m, w.radius_m);
  for (const Caster& c : u.robot.casters) add(c.centre_m, c.radius_m);
  return {(high - low) / 2, (high + low) / 2};
}

}  // namespace

std::string robot_picture(const UnderstoodRobot& u) {
  const auto [half, middle] = extent(u);
  const double scale = (kView_px / 2) / half.maxCoeff();
  const double height = kView_px + kTop_px + kMargin_px, width = 2 * kView_px + 3 * kMargin_px;
  const View above{kMargin_px + kView_px / 2, kTop_px + kView_px / 2, scale, middle, true};
  const View side{2 * kMargin_px + 1.5 * kView_px, kTop_px + kView_px / 2, scale, middle, false};
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {:g} {:g}\" width=\"{:g}\" height=\"{:g}\" "
      "font-family=\"sans-serif\" font-size=\"12\">\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n",
      width, height, width, height);
  svg += text_at(kMargin_px, 24,
                 fmt::format("{}: {:.2f} kg, track {:.1f} mm, wheel radius {:.1f} mm", u.robot.urdf, u.body.mass_kg,
                             1e3 * u.robot.wheelbase_m(), 1e3 * u.robot.wheels[0].radius_m),
                 "font-size=\"15\"");
  svg += text_at(kMargin_px, 48, "from above, ahead is to the right") +
         text_at(side.left_px - kView_px / 2, 48, "from its right");
  const Vector3d floor(0, 0, -u.robot.wheels[0].radius_m);
  const double reach_m = half.maxCoeff();
  svg += side.line(floor + Vector3d(middle.x() - reach_m, 0, 0), floor + Vector3d(middle.x() + reach_m, 0, 0),
                   "stroke=\"#333333\" stroke-width=\"2\"");
  svg += above.line(u.robot.wheels[0].centre_m, u.robot.wheels[1].centre_m, kThin);
  for (const View& view : {above, side}) svg += supports(view, u.robot) + cross(view, u.body.com_m);
  svg += loads(above, u);
  const double metre = std::pow(10, std::floor(std::log10(half.maxCoeff())));
  svg += fmt::format("<path d=\"M{:.1f} {:.1f}h{:.1f}\" stroke=\"black\" stroke-width=\"3\"/>\n", kMargin_px,
                     height - 24, scale * metre);
  svg += text_at(kMargin_px, height - 8, fmt::format("{:g} mm", 1e3 * metre));
  return svg + "</svg>\n";
}

}  // namespace umbsim
