#include "sim/urdf_drive_remarks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace umbsim {
namespace {

bool names(const std::string& text, const char* side) {
  std::string lower = text;
  std::transform(lower.begin(), lower.end(), lower.begin(), [](unsigned char c) { return std::tolower(c); });
  return lower.find(side) != std::string::npos;
}

}  // namespace

void remark_drive(const UrdfSource& source, const std::vector<Body>& bodies, const Drive& drive) {
  using Kind = Remark::Kind;
  constexpr const char* kSides[] = {"left", "right"};
  for (int side = 0; side < 2; ++side) {
    const RollingWheel& wheel = drive.wheels[side];
    const std::string joint = source.joint_text(bodies[wheel.body].joint);
    if (names(bodies[wheel.body].joint, kSides[1 - side])) {
      source.remark(Kind::understood,
                    fmt::format("{}: it is the {} wheel by its place (y = {:.4g} m in the root), its name "
                                "says {}",
                                joint, kSides[side], wheel.centre_m.y(), kSides[1 - side]));
    }
    if (wheel.taken_from.empty()) continue;
    source.remark(Kind::assumed, fmt::format("{}: wheel radius {:.4g} m, width {:.4g} m from {}", joint, wheel.radius_m,
                                             wheel.width_m, wheel.taken_from));
  }
  const double left_m = drive.wheels[0].radius_m, right_m = drive.wheels[1].radius_m;
  if (left_m != right_m) {
    source.remark(Kind::understood,
                  fmt::format("the URDF's wheel radii differ: left {:g} m, right {:g} m", left_m, right_m));
  }
}

}  // namespace umbsim
