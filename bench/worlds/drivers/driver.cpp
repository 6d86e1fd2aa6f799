#include "bench/worlds/drivers/driver.h"

#include "bench/worlds/drivers/kinds.h"
#include "core/error.h"

namespace umbsim::worlds {
namespace {

constexpr double kOpenLoop = 0.2;  // share of the drivers with a clock that never look
constexpr double kRates_hz[] = {10, 20, 25, 40, 50, 100};

/// Sees nothing but its own commands, added up.
class OpenLoop : public Driver {
 public:
  OpenLoop(std::unique_ptr<Driver> driver, const DriveGeometry& believed, double period_s)
      : driver_(std::move(driver)), believed_(believed), period_s_(period_s) {}
  WheelSpeeds command(double time_s, const Seen&) override {
    // Set-points ramp from one command to the next: what comes of the last two is their mean.
    const WheelSpeeds next = driver_->command(time_s, {X_SB_, X_SB_});
    const double left_m = (last_.left_radps + next.left_radps) / 2 * period_s_ * believed_.left_radius_m;
    const double right_m = (last_.right_radps + next.right_radps) / 2 * period_s_ * believed_.right_radius_m;
    X_SB_ = X_SB_ * arc((left_m + right_m) / 2, (right_m - left_m) / believed_.wheelbase_m);
    last_ = next;
    return next;
  }
  bool done() const override { return driver_->done(); }
  int segment() const override { return driver_->segment(); }
  bool jumps() const override { return driver_->jumps(); }

 private:
  std::unique_ptr<Driver> driver_;
  DriveGeometry believed_;
  double period_s_;
  Pose2 X_SB_;
  WheelSpeeds last_;
};

/// The same driver on motors whose set-points do not ramp.
class Jumping : public Driver {
 public:
  explicit Jumping(std::unique_ptr<Driver> driver) : driver_(std::move(driver)) {}
  WheelSpeeds command(double time_s, const Seen& seen) override { return driver_->command(time_s, seen); }
  bool done() const override { return driver_->done(); }
  int segment() const override { return driver_->segment(); }
  bool jumps() const override { return true; }

 private:
  std::unique_ptr<Driver> driver_;
};

std::unique_ptr<Driver> closed_loop(const DriverChoice& c, const Way& way, const DriveGeometry& believed,
                                    RandomStream random) {
  if (c.kind == "own") return make_own(way, believed, 1 / c.rate_hz);
  if (c.kind == "s_curve") return make_s_curve(way, believed, 1 / c.rate_hz);
  if (c.kind == "heading") return make_heading(c, way, believed);
  if (c.kind == "pursuit") return make_pursuit(c, way, believed);
  if (c.kind == "jumps") return make_jumps(c, way, believed);
  if (c.kind == "joystick") return make_joystick(c, way, believed, std::move(random));
  throw InputError("no driver '" + c.kind + "'");
}

}  // namespace

DriverChoice draw_driver(const std::string& kind, RandomStream& random) {
  DriverChoice c;
  c.kind = kind;
  c.rate_hz = kRates_hz[std::min(std::size_t(5), std::size_t(random.uniform(0, 6)))];
  c.open_loop = random.uniform() < kOpenLoop && (kind == "own" || kind == "s_curve");
  c.heading_gain_1ps = random.uniform(1, 2.5);
  c.across_gain_radpms = random.uniform() < 0.5 ? 0 : random.uniform(0.5, 1.5);
  c.look_ahead_m = random.uniform(0.25, 0.6);
  c.dead_time_s = random.uniform(0.15, 0.35);
  c.tremor_radps = random.uniform(0.01, 0.05);
  if (kind == "joystick") {  // a hand is slower than a loop, and nobody steers by heading alone
    c.heading_gain_1ps = random.uniform(0.8, 1.4);
    c.across_gain_radpms = random.uniform(0.4, 0.9);
  }
  return c;
}

std::unique_ptr<Driver> make_driver(const DriverChoice& choice, const Way& way, const DriveGeometry& believed,
                                    RandomStream random) {
  std::unique_ptr<Driver> driver = closed_loop(choice, way, believed, std::move(random));
  if (choice.jumps) driver = std::make_unique<Jumping>(std::move(driver));
  if (!choice.open_loop) return driver;
  return std::make_unique<OpenLoop>(std::move(driver), believed, 1 / choice.rate_hz);
}

}  // namespace umbsim::worlds
