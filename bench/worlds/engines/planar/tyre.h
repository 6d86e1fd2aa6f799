#pragma once

#include <Eigen/Core>

namespace umbsim::worlds::planar {

/// How friction builds up between a rubber tread and the floor. Below sliding the tread is a spring that rolling
/// renews; at the friction limit it slides. The state is the tread's deflection (Pacejka, Tire and Vehicle Dynamics,
/// 3rd ed., ch. 7: single contact point, fully non-linear; Canudas de Wit, Tsiotras, Velenis, Basset & Gissinger 2003,
/// Dynamic friction models for road/tire longitudinal interaction: lumped LuGre with the term that carries bristles
/// away).
struct TyreLaw {
  enum class Curve {
    brush,  ///< steady force 3 x - 3 x^2 + x^3 of the limit, x = slip / (3 friction creep): parabolic pressure
    lugre   ///< steady force slip / (slip + friction creep) of the limit
  };
  Curve curve = Curve::brush;
  double stiffness_pm = 5000;  ///< force over load per metre of deflection
  double damping_spm = 10;     ///< force over load per speed of deflection
  double creep_along = 0.005;  ///< slip per force over load, where both are small
  double creep_across = 0.005;
};

/// One piece of tread. Vectors are (along, across) the way that it rolls.
class Tread {
 public:
  /// Force on the robot after a step of `step_s` at which the tread's foot is dragged over the floor at `slip_mps`,
  /// while `rolling_mps` of tread pass. Never more than friction * load.
  Eigen::Vector2d step(const TyreLaw& law, double friction, double load_n, const Eigen::Vector2d& slip_mps,
                       double rolling_mps, double step_s);

  const Eigen::Vector2d& deflection_m() const { return deflection_m_; }

 private:
  Eigen::Vector2d deflection_m_ = Eigen::Vector2d::Zero();
};

}  // namespace umbsim::worlds::planar
