#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "sim/dynamics/contact.h"
#include "sim/dynamics/contact_solver.h"
#include "sim/dynamics/multibody.h"
#include "sim/dynamics/sticking.h"
#include "sim/snapshot.h"
#include "sim/world.h"

namespace umbsim {

/// A wheel, ball or caster wheel that may touch the floor.
struct Support {
  int joint = -1;            // -1: a ball fixed to the base
  Eigen::Vector3d centre_m;  // base frame, of a fixed ball
  double radius_m = 0;
  bool disc = false;
  int wheel = -1;             // drive wheels: 0 left, 1 right
  double friction_scale = 0;  // times the floor's; balls have a coefficient of their own
  double own_friction = 0;
  std::string name;
  // Compliance along the normal; stiffness 0 stands for rigid.
  double sink_m = 0;
  double stiffness_npm = 0;
  double damping_nspm = 0;
  // Between it and the base.
  Suspension spring{};
  double up_m = 0;    // its deflection
  double up_mps = 0;  // in the last step
  int stop = 0;       // at which it stands: 1 the upper, -1 the lower, 0 none
};

/// What acts on the base from outside in a step: angular about its centre of mass, then linear, base frame.
using Impulse = Eigen::Matrix<double, 6, 1>;

/// How a rolling tyre slips before it slides.
struct TyreSlip {
  double along = 0;  ///< m/s per N
  double across = 0;
  Eigen::Vector3d surface_mps = Eigen::Vector3d::Zero();  ///< speed of the carpet under the wheel, world frame
};

/// How the friction of a contact of finite width, or of a bearing, resists turning.
struct TurningPatch {
  bool turns = false;
  double limit = 0;  // of the impulse
  double compliance = 0;
};

/// What a motor does to its wheel in a step. Where there is play, it pushes one way only, at that end of the play which
/// would be reached first.
struct Shaft {
  int side = 0;      // of the play: 1 forwards, -1 backwards, 0 without play
  double radps = 0;  // at which it holds the wheel
  double limit = 0;  // of its impulse
  double give = 0;   // impulse per speed that the wheel is behind, of a motor that gives way; 0: it holds
};

/// A rolling step in the making.
struct Rolling {
  HeldBody held;
  Shaft shaft[2];
  double wheel_radps[2];  // held speeds; of wheels that are not held, those before
  Sticking sticking[8];
  TurningPatch patch[8];
  TurningPatch swivel[4];     // of the legs' bearings
  Eigen::Vector3d change[8];  // of the speeds of the contacts' points
  Tangent tangent[8];
  Touch touch[8];
  Likeness like[8];
  Eigen::Vector3d force[8];
  double bounded[12];  // impulses of patches and bearings
  int bounded_rows = 0;
};

/// A rolling step on a plane in the making (sim/plane.cpp).
struct OnPlane {
  Eigen::Vector3d normal;
  Eigen::Vector3d arm_m[8];             // of the contacts, from the base's centre of mass
  Eigen::Vector3d middle_m, half_m;     // between the wheels' contacts, and from there to the left one
  Eigen::Vector3d along[2], across[2];  // of the wheels
  double rolling_m[2];
  Eigen::Vector3d slip_mps[2];      // of the wheels' contacts, before the step
  Eigen::Vector3d turn_m[8];        // speed of the contacts along the normal per rate of turning
  double give[8], speed_mps[8];     // along the normal
  Eigen::Vector3d turning, moving;  // what changes
  double rising = 0;
  double push_ns[8], along_ns[2], across_ns[2];
};

/// What the laws say of a solution: they hold, they are on other branches, or a contact slides that was to stick.
enum class Laws { hold, change, slide };

/// Everything that a world holds. world.cpp: the interface; step.cpp: one time step; contact_rows.cpp: what touches;
/// rolling.cpp: the step of most moments; plane.cpp: the same on a plane; long_step.cpp: one of any length;
/// placing.cpp: how the robot is set down; springs.cpp: what carries it; strain.cpp: how its wheels were loaded.
struct World::State {
  RobotModel robot;
  Drivetrain drivetrain;
  Floor floor;
  PhysicsOptions options;
  std::vector<Push> pushes;
  Pull pull;
  MultiBody body;
  std::vector<Support> supports;
  SupportLoads loads;
  PhysicsCost cost;
  std::array<double, 2> command_radps{};
  std::array<double, 2> last_command_radps{};
  std::array<double, 2> zero_angle_rad{};
  std::array<double, 2> set_point_radps{};    // behind the motors' lag
  std::array<double, 2> shaft_rad{};          // motor side of the backlash
  std::array<double, 2> radius_factor{1, 1};  // of rolling, not of the shape
  std::array<double, 2> rest_load_n{};        // that squashes a tyre at rest
  bool sprung = false;                        // any support
  struct {
    double least_n = 0, sum_ns = 0, unloaded_s = 0, since_s = 0, longest_s = 0, longest_from_s = 0, slid_s = 0;
  } strain[2];
  double last_step_s = 0;
  bool by_rolling = false;  // that one
  double time_s = -1;       // since place; pushes act from 0 on
  double heading_rad = 0;
  double ahead_x = 1, ahead_y = 0;  // of the base's x axis when it was turned by that
  bool on_balls = false;            // the robot may take the step on a plane
  double widest_m = 0;              // how far the farthest support reaches from the base's origin
  double stood_s = 0;               // when the robot stood last, and how it was turned
  double stood_heading_rad = 0;

  // Rows of the current step: each is J_i, with response M^-1 J_i^T, and a compliance on the diagonal (velocity per
  // impulse).
  ContactProblem problem;
  DofVector row[kMaxRows];
  DofVector response[kMaxRows];
  double compliance[kMaxRows]{};
  int rows = 0;
  int contact_support[8]{};
  Contact contact[8];
  int contacts = 0;
  std::array<double, 2> spinning_radps{};  // of the wheels in this step, as far as it is known before
  bool doubtful = false;                   // whether a support is nearly near enough to be one of them
  Grip grip;                               // of the last rolling step
  RowVector impulses;
  SolveReport report;

  State(const RobotModel& r, const Drivetrain& d, const Floor& f, const PhysicsOptions& o, const std::vector<Push>& p);

  RollingShape shape(const Support& s) const;
  Eigen::Vector3d rim_centre(const Support& s, const Joint& hinge, double ahead_rad = 0) const;
  double outer_radius(const Support& s) const;
  double loaded_radius(const Support& s) const;
  double rolling_radius(const Support& s) const;
  double load(const Support& s) const;
  std::array<double, 2> follow_commands(double step_s, double part);
  double motor_compliance(int wheel, double step_s) const;
  void step(double step_s, const std::array<double, 2>& target_radps);
  void find_speeds(double step_s, const std::array<double, 2>& target_radps);
  void move_on(double step_s, const std::array<double, 2>& target_radps);
  bool one_step_will_do(double step_s, const std::array<double, 2>& target_radps) const;
  bool roll(double step_s, const std::array<double, 2>& target_radps, double peak_mps2);
  void end_at(const std::array<double, 2>& wheel_radps);
  void as_after_one_of(double step_s);
  bool wheel_slides(int i, double spare_ns = 0) const;
  bool slides(double spare_ns = 0) const;
  ContactsBefore contacts_before() const;
  void begin_from(const ContactsBefore& before);
  void step_anywhere(double step_s, const std::array<double, 2>& target_radps, const Impulse& given);
  bool step_rolling(double step_s, const std::array<double, 2>& target_radps, const Impulse& given, DofVector& u);
  double way_m(double step_s, bool kicked) const;
  bool runs_on_balls() const;
  bool is_on_plane(double step_s) const;
  bool touch_plane(double step_s, OnPlane& now) const;
  bool solve_on_plane(double step_s, const std::array<double, 2>& target_radps, OnPlane& now) const;
  bool holds_on_plane(double step_s, const std::array<double, 2>& target_radps, OnPlane& now) const;
  void write_on_plane(const OnPlane& now);
  bool step_on_plane(double step_s, const std::array<double, 2>& target_radps);
  bool find_certain_contacts(double step_s, const std::array<double, 2>& target_radps, bool kicked);
  bool start_rolling(double step_s, Rolling& now);
  void start_contact(const Contact& c, const Rolling& now, Sticking& sticking) const;
  void start_shafts(double step_s, const std::array<double, 2>& target_radps, Rolling& now) const;
  bool wheel_is_free(int wheel, const Rolling& now) const {
    return grip.motor[wheel] != 0 || now.shaft[wheel].limit <= 0 || now.shaft[wheel].give > 0;
  }
  bool shares_spring(const Contact& c) const;
  void set_springs(double step_s);
  void let_stick(double step_s, Rolling& now);
  bool hold(double step_s, const Impulse& given, Rolling& now, StickingProblem& motion);
  bool hold_or_slide(double step_s, const Impulse& given, Rolling& now, StickingProblem& motion);
  bool slide(double step_s, const Impulse& given, Rolling& now, StickingProblem& motion);
  void set_likeness(Rolling& now) const;
  void take_tangents(Rolling& now);
  bool none_slides(const Rolling& now) const;
  void take_touch_before(Rolling& now) const;
  double touch_all(Rolling& now);
  bool solve_rolling(Rolling& now, StickingProblem& motion) const;
  Laws check_sticking(Rolling& now);
  Laws check_bounded(const StickingProblem& motion, Rolling& now);
  bool stops_change(double step_s, const Rolling& now);
  bool check_motors(const StickingProblem& motion, const Rolling& now);
  int motor_state(int wheel, double impulse, double radps, const Rolling& now) const;
  void write_impulses(const Rolling& now);
  void finish_rolling(const StickingProblem& motion, const Rolling& now, DofVector& u);
  bool step_with_holding_motors(double step_s, const std::array<double, 2>& target_radps, bool found, DofVector& u);
  void step_with_motor_rows(double step_s, const std::array<double, 2>& target_radps, DofVector& u);

  void find_contacts(double step_s, double watch_m, double doubt_m, const std::array<double, 2>& wheel_radps);
  void add_contact(int support, const Joint& hinge, const Eigen::Vector3d& normal, double gap_m, double floor_friction,
                   double step_s, const std::array<double, 2>& wheel_radps);
  void soften_contact(Contact& c, double gap_m, double step_s) const;
  bool off_centre() const { return robot.wheels[0].eccentricity_m > 0 || robot.wheels[1].eccentricity_m > 0; }
  std::array<double, 2> expected_radps(const std::array<double, 2>& target_radps) const;
  void add_contacts(double step_s, const DofVector& u, const std::array<double, 2>& target_radps, bool found = false);
  void add_contact_rows(const Contact& c, const DofVector& u);
  TyreSlip tyre_slip(const Support& s) const;
  double creeping_load(const Support& s) const;
  double turning_radps(const Eigen::Vector3d& normal) const;
  double slip_of_turning_patch(const Support& s, double friction, const Eigen::Vector3d& normal) const;
  TurningPatch turning_patch(const Contact& c, double step_s) const;
  void add_spin_friction(const DofVector& u, double step_s);
  void add_motor(int wheel, double target_radps, double step_s, const DofVector& u);
  void add_swivel_friction(double step_s, const DofVector& u);
  void add_backlash(int wheel, double target_radps, double step_s, const DofVector& u);
  void move_shafts(double step_s, const std::array<double, 2>& target_radps);
  Impulse given_impulse(double step_s) const;
  void add_pushes(double step_s, Impulse& given) const;
  Eigen::Vector3d gravity_mps2() const;
  void set_gravity() { body.set_gravity(gravity_mps2()); }
  void add_pull(double step_s, Impulse& given) const;
  template <int N>
  void assemble(const double* M_inverse, int dofs, int stride);
  void solve(double step_s);
  void solve_on_springs(double step_s);
  void add_springs(double step_s);
  double spring_speed(const Support& s, double force_n, double step_s) const;
  bool change_stops(double step_s);
  bool change_stops(double step_s, const double (&force_n)[8]);
  void move_springs(double step_s);
  Eigen::Vector3d shift(const Support& s) const { return {0, 0, s.up_m}; }
  void note_strain(double step_s);
  void count(const SolveReport& report);
  void note_loads(double step_s);

  void place_on_floor(const Pose2& X_WB);
  void soften();
  void check_loads() const;
  void check_finite() const;
  bool stands() const;
  void watch_standing();
  bool near_cable(double gap_m, double margin_m) const;
  void set_heading(double heading);
  void track_heading();
};

/// Speed that a newton leaves between two surfaces in "rigid" contact. It makes the problem regular (the lateral
/// friction of both wheels lies on one line); at 100 N it is 0.1 um/s.
constexpr double kMobility = 1e-9;  // m/s per N

/// Contacts this far ahead are watched, beyond what the step can travel.
constexpr double kSpeculative_m = 0.001;

/// Of the row of a swivel bearing with dry friction. Where it turns slower than a share of its wheel's rolling rate
/// friction fades in proportion: a shaken bearing creeps (docs/contact.md).
inline double swivel_compliance(const Caster& caster, double rolling_radps, double step_s) {
  constexpr double kSwivelMobility = 1e-9;  // rad/s per N m: makes the problem regular, as kMobility does
  return (kSwivelMobility + caster.bearing_creep * std::abs(rolling_radps) / caster.swivel_friction_nm) / step_s;
}

}  // namespace umbsim
