// The catalogue: one line for each effect. The values in a line, in order: parameter, unit, member, bounds, plausible
// magnitudes from and to, typical value; then lecture, source, description, signature, confused with. Long, for it is
// one table of 28 effects and nothing else.
#include "effects/catalogue.h"
#include "effects/contact.h"
#include "effects/drivetrain.h"
#include "effects/encoder.h"
#include "effects/floor.h"
#include "effects/geometry.h"

namespace umbsim {
namespace {

// A parameter that is a member of an effect's struct. Its default there is the neutral value.
template <class E>
struct Member {
  const char* name;
  const char* unit;
  double E::*member;
  Bounds bounds;
  double plausible_min;
  double plausible_max;
  double typical;
};

template <class E>
EffectInfo line(const char* name, Stage stage, std::vector<Member<E>> members, EffectText text) {
  EffectInfo info{name, stage, {}, std::move(text), false, {}};
  if constexpr (requires(E e) { e.run; }) info.one_run = true;
  for (const Member<E>& m : members) {
    info.parameters.push_back({m.name, m.unit, E{}.*m.member, m.bounds, m.plausible_min, m.plausible_max, m.typical});
  }
  info.apply = [members](const EffectValues& values, Rig& rig) {
    E effect;
    for (std::size_t i = 0; i < members.size(); ++i) effect.*members[i].member = values.numbers[i];
    if constexpr (requires { effect.run; }) effect.run = values.run;
    umbsim::apply(effect, rig);
  };
  return info;
}

}  // namespace

const std::vector<EffectInfo>& catalogue() {
  static const std::vector<EffectInfo> table = {
      line<WheelRadiusScale>(
          "wheel_radius_scale", Stage::geometry,
          {{"relative", "1", &WheelRadiusScale::relative, Bounds::between(-0.5, 0.5), 0.001, 0.03, 0.01}},
          {"Systematic: mean of the wheel radii off nominal", "Lecture 7.3; Borenstein & Feng 1996",
           "Both wheel radii are (1 + relative) times nominal: every leg is too long or too short.",
           "every leg's length, in proportion to distance; closed squares hide it",
           "encoder_missed_counts, encoder_resolution, tyre_compliance without a payload run"}),
      line<WheelRadiusDifference>(
          "wheel_radius_difference", Stage::geometry,
          {{"relative", "1", &WheelRadiusDifference::relative, Bounds::between(-0.5, 0.5), 0.0005, 0.01, 0.002}},
          {"Systematic: unequal wheel radii", "Lecture 7.3; Borenstein & Feng 1996 (E_d, type B error)",
           "Right over left radius is 1 + relative, the mean stays.", "legs curve, in the same sense cw and ccw",
           "encoder_missed_counts of one wheel, caster_drag off the middle, wear"}),
      line<Wheelbase>("wheelbase", Stage::geometry,
                      {{"relative", "1", &Wheelbase::relative, Bounds::between(-0.5, 0.5), 0.002, 0.05, 0.01}},
                      {"Systematic: wheelbase off nominal", "Lecture 7.3; Borenstein & Feng 1996 (E_b, type A error)",
                       "The wheels stand (1 + relative) times the nominal wheelbase apart.",
                       "turns, in proportion to their angle", "contact_patch"}),
      line<WheelMisalignment>(
          "wheel_misalignment", Stage::geometry,
          {{"left_toe_rad", "rad", &WheelMisalignment::left_toe_rad, Bounds::between(-0.2, 0.2), 0.0017, 0.0175, 0},
           {"right_toe_rad", "rad", &WheelMisalignment::right_toe_rad, Bounds::between(-0.2, 0.2), 0.0017, 0.0175,
            0.006}},
          {"Systematic: misaligned wheels", "Lecture 7.3",
           "Each wheel's plane is turned about the vertical (toe), counter-clockwise positive.",
           "sideways drift in proportion to distance, in the robot's frame; scrubbing",
           "carpet_drift without rotated starts"}),
      line<WheelEccentricity>(
          "wheel_eccentricity", Stage::geometry,
          {{"left_m", "m", &WheelEccentricity::left_m, Bounds::between(0, 0.02), 0.0001, 0.002, 0},
           {"right_m", "m", &WheelEccentricity::right_m, Bounds::between(0, 0.02), 0.0001, 0.002, 0.001},
           {"left_phase_rad", "rad", &WheelEccentricity::left_phase_rad, Bounds::between(-3.2, 3.2), 0, 3.14, 0},
           {"right_phase_rad", "rad", &WheelEccentricity::right_phase_rad, Bounds::between(-3.2, 3.2), 0, 3.14, 0}},
          {"Systematic: unequal wheel radii, round the wheel", "Lecture 7.3; Kelly 2004",
           "The axle is off the wheel's centre.", "periodic in the wheel's angle; drift only of second order",
           "uneven_floor of the wheel's circumference"}),
      line<LoadShift>("load_shift", Stage::geometry,
                      {{"payload_kg", "kg", &LoadShift::payload_kg, Bounds::between(0, 1000), 0, 20, 15},
                       {"ahead_m", "m", &LoadShift::ahead_m, Bounds{}, 0, 0.3, 0},
                       {"left_m", "m", &LoadShift::left_m, Bounds{}, 0, 0.2, 0.1},
                       {"height_m", "m", &LoadShift::height_m, Bounds{}, 0, 0.5, 0.1}},
                      {"Systematic: wheel radii under load", "Borenstein & Feng 1996 (tyres under load)",
                       "A payload at a place of the base; acts on radii through tyre_compliance and on traction.",
                       "differs between loaded and empty runs", "tyre_compliance"}),
      line<Wear>("wear", Stage::geometry,
                 {{"left_relative_per_run", "1/run", &Wear::left_relative_per_run, Bounds::between(-0.05, 0.05), 0.0001,
                   0.005, 0},
                  {"right_relative_per_run", "1/run", &Wear::right_relative_per_run, Bounds::between(-0.05, 0.05),
                   0.0001, 0.005, -0.0005}},
                 {"Systematic: radii that change slowly", "Lecture 7.5 (systematic errors change with wear and load)",
                  "Wheel radii change from run to run.", "a drift over the run number",
                  "wheel_radius_difference on few runs"}),
      line<Backlash>("backlash", Stage::drivetrain,
                     {{"left_rad", "rad", &Backlash::left_rad, Bounds::between(0, 0.5), 0.0035, 0.052, 0.02},
                      {"right_rad", "rad", &Backlash::right_rad, Bounds::between(0, 0.5), 0.0035, 0.052, 0.02}},
                     {"Non-systematic: internal forces; play", "Gear play between motor encoder and wheel",
                      "A dead zone between the motor with its encoder and the wheel.",
                      "at reversals only: one wheel at each turn's start and end",
                      "wheelbase (its part that is the same at every turn)"}),
      line<MotorResponse>(
          "motor_response", Stage::drivetrain,
          {{"lag_s", "s", &MotorResponse::lag_s, Bounds::between(0, 5), 0.02, 0.2, 0.1},
           {"deadband_radps", "rad/s", &MotorResponse::deadband_radps, Bounds::between(0, 10), 0.01, 0.1, 0},
           {"gain_asymmetry", "1", &MotorResponse::gain_asymmetry, Bounds::between(-0.5, 0.5), 0.01, 0.1, 0.03},
           {"torque_limit_nm", "N m", &MotorResponse::torque_limit_nm, Bounds::between(0, 1000000.0), 1, 50, 0},
           {"droop_radps_per_nm", "rad/s per N m", &MotorResponse::droop_radps_per_nm, Bounds::between(0, 1000.0), 0.01,
            10, 0}},
          {"Not listed: control, seen in commands against ticks",
           "First-order lag with dead band; e.g. BAM (actuator identification)",
           "Motors lag, ignore small commands, turn faster on one side, or give way under their load.",
           "commands against ticks; the odometry itself sees it", "none on ticks"}),
      line<OverAcceleration>("over_acceleration", Stage::contact,
                             {{"factor", "1", &OverAcceleration::factor, Bounds::between(0.01, 1000), 2, 30, 25}},
                             {"Non-systematic: slip from over-acceleration", "Lecture 7.3",
                              "The course's accelerations times a factor: wheels slip where traction exceeds friction.",
                              "starts and stops of legs and turns", "slippery_floor"}),
      line<FastTurning>("fast_turning", Stage::contact,
                        {{"factor", "1", &FastTurning::factor, Bounds::between(0.01, 100), 2, 10, 8}},
                        {"Non-systematic: slip from fast turning (skidding)", "Lecture 7.3",
                         "The turns' angular speed and acceleration times a factor: the wheels skid.", "turns",
                         "slippery_floor, contact_patch"}),
      line<EncoderResolution>(
          "encoder_resolution", Stage::encoder,
          {{"ticks_per_revolution", "1", &EncoderResolution::ticks_per_revolution, Bounds::between(0, 1000000000.0), 50,
            10000, 100}},
          {"Systematic: finite encoder resolution", "Lecture 7.3", "Ticks per wheel revolution; 0: the scenario's.",
           "a floor of quantisation under every figure", "measurement noise"}),
      line<EncoderSampling>(
          "encoder_sampling", Stage::encoder,
          {{"interval_s", "s", &EncoderSampling::interval_s, Bounds::between(0, 10), 0.001, 0.2, 0.1}},
          {"Systematic: finite sampling interval", "Lecture 7.3", "The counters are latched only at this interval.",
           "where the path curves", "encoder_latency"}),
      line<EncoderMissedCounts>(
          "encoder_missed_counts", Stage::encoder,
          {{"left_probability", "1", &EncoderMissedCounts::left_probability, Bounds::between(0, 1), 0.0005, 0.01, 0},
           {"right_probability", "1", &EncoderMissedCounts::right_probability, Bounds::between(0, 1), 0.0005, 0.01,
            0.002},
           {"probability_per_radps", "s/rad", &EncoderMissedCounts::probability_per_radps, Bounds::between(0, 1), 0,
            0.001, 0}},
          {"Systematic: finite encoder resolution (lost counts)", "Lost quadrature edges",
           "Each tick is missed with a probability, which may grow with speed.",
           "one wheel seems short, in proportion to distance", "wheel_radius_difference, wheel_radius_scale"}),
      line<EncoderLatency>("encoder_latency", Stage::encoder,
                           {{"seconds", "s", &EncoderLatency::seconds, Bounds::between(0, 2), 0.005, 0.2, 0.1}},
                           {"Systematic: finite sampling interval (delay)", "Transport delay of a bus or driver",
                            "Readings arrive late, so the driver overshoots.",
                            "overshoot of angular speed times delay at every turn; none in the odometry's return error",
                            "motor_response lag"}),
      line<TyreCompliance>(
          "tyre_compliance", Stage::contact,
          {{"metres_per_newton", "m/N", &TyreCompliance::metres_per_newton, Bounds::between(0, 0.001), 2e-07, 5e-06,
            1.5e-06}},
          {"Systematic: mean of the wheel radii off nominal, under load",
           "Borenstein & Feng 1996; tyre vertical stiffness", "The rolling radius shrinks in proportion to load.",
           "distance and heading in proportion to payload", "wheel_radius_scale without a payload run"}),
      line<ContactPatch>("contact_patch", Stage::contact,
                         {{"width_m", "m", &ContactPatch::width_m, Bounds::between(0, 0.5), 0, 0.04, 0.02}},
                         {"Non-systematic: no point contact between wheel and floor",
                          "Line contact of uniform pressure that slides as it turns: moment mu N w / 4, slip along",
                          "A contact of finite width resists turning, and slips along while it turns.",
                          "turns, in proportion to their angle, more of it while they speed up", "wheelbase"}),
      line<TyreCreep>("tyre_creep", Stage::contact,
                      {{"along", "1", &TyreCreep::along, Bounds::between(0, 1), 0.001, 0.05, 0.01},
                       {"across", "1", &TyreCreep::across, Bounds::between(0, 1), 0.001, 0.05, 0.01},
                       {"slip_along_mps_per_n", "m/s per N", &TyreCreep::slip_along_mps_per_n, Bounds::between(0, 10),
                        1e-05, 0.001, 0},
                       {"slip_across_mps_per_n", "m/s per N", &TyreCreep::slip_across_mps_per_n, Bounds::between(0, 10),
                        1e-05, 0.001, 0}},
                      {"Non-systematic: wheel slip",
                       "Johnson, Contact Mechanics, ch. 8 (linear creep); Open Dynamics Engine manual (slip1, slip2)",
                       "Slip in proportion to traction before sliding: as a share of the way, or as a speed.",
                       "acceleration, slopes, arcs", "tyre_compliance"}),
      line<CasterSwivel>(
          "caster_swivel", Stage::contact,
          {{"trail_m", "m", &CasterSwivel::trail_m, Bounds::between(0, 0.5), 0.01, 0.05, 0.03},
           {"friction_nm", "N m", &CasterSwivel::friction_nm, Bounds::between(0, 100), 0.01, 1, 0.2},
           {"initial_angle_rad", "rad", &CasterSwivel::initial_angle_rad, Bounds::between(-3.2, 3.2), 0, 3.14, 0},
           {"bearing_creep", "1", &CasterSwivel::bearing_creep, Bounds::between(0, 1), 0.001, 0.05, 0.05}},
          {"Non-systematic: internal forces (casters)", "Lecture 7.3; Borenstein & Feng 1996 (castor wheels)",
           "The first caster is a swivelling wheel with trail and bearing friction.",
           "a kick in the first trail-lengths after each turn", "tyre_creep after turns"}),
      line<CasterDrag>("caster_drag", Stage::contact,
                       {{"coefficient", "1", &CasterDrag::coefficient, Bounds::between(0, 2), 0.01, 0.05, 0.03},
                        {"left_m", "m", &CasterDrag::left_m, Bounds::between(-1, 1), 0, 0.05, 0}},
                       {"Non-systematic: internal forces (casters)", "Rolling resistance of casters",
                        "Fixed casters drag with a share of their load, perhaps off the middle.",
                        "only through slip or creep: yaw in proportion to distance", "wheel_radius_difference"}),
      line<SlipperyFloor>(
          "slippery_floor", Stage::floor,
          {{"friction", "1", &SlipperyFloor::friction, Bounds::between(0, 5), 0.03, 0.4, 0.03}},
          {"Non-systematic: slip from a slippery floor", "Lecture 7.3",
           "Friction of the whole floor; 0: the scenario's.", "acceleration and turns", "over_acceleration"}),
      line<SlipperyPatch>("slippery_patch", Stage::floor,
                          {{"x_m", "m", &SlipperyPatch::x_m, Bounds{}, 0, 4, 0.2},
                           {"y_m", "m", &SlipperyPatch::y_m, Bounds{}, 0, 4, -0.17},
                           {"radius_m", "m", &SlipperyPatch::radius_m, Bounds::between(0, 100), 0.05, 0.5, 0.3},
                           {"friction", "1", &SlipperyPatch::friction, Bounds::between(0, 5), 0.02, 0.3, 0.02}},
                          {"Non-systematic: slip from a slippery floor", "Lecture 7.3",
                           "Friction inside a disc on the floor.", "a place on the floor", "bump"}),
      line<Bump>(
          "bump", Stage::floor,
          {{"height_m", "m", &Bump::height_m, Bounds::between(0, 0.05), 0.002, 0.012, 0.006},
           {"x_m", "m", &Bump::x_m, Bounds{}, 0, 4, 2},
           {"y_m", "m", &Bump::y_m, Bounds{}, 0, 4, -0.17},
           {"direction_rad", "rad", &Bump::direction_rad, Bounds::between(-3.2, 3.2), 0, 3.14, Bump{}.direction_rad},
           {"length_m", "m", &Bump::length_m, Bounds::between(0.001, 100), 0.05, 1, Bump{}.length_m}},
          {"Non-systematic: unexpected objects", "Borenstein 1994 (extended UMBmark)",
           "A round cable on the floor in every run.", "a heading step at a place, one wheel", "push in one run"}),
      line<UnevenFloor>(
          "uneven_floor", Stage::floor,
          {{"rms_m", "m", &UnevenFloor::rms_m, Bounds::between(0, 0.02), 0.0005, 0.005, 0.001},
           {"wavelength_m", "m", &UnevenFloor::wavelength_m, Bounds::between(0.02, 100), 0.1, 2,
            UnevenFloor{}.wavelength_m},
           {"seed", "1", &UnevenFloor::seed, Bounds::between(0, 1000000000000000.0), 1, 1000, UnevenFloor{}.seed}},
          {"Non-systematic: uneven floor", "Lecture 7.3", "A smooth random height field, the same in every run.",
           "a random walk of heading that repeats on the same path", "wheel_eccentricity"}),
      line<FloorSlope>("floor_slope", Stage::floor,
                       {{"slope_rad", "rad", &FloorSlope::slope_rad, Bounds::between(0, 0.5), 0.0017, 0.035, 0.02},
                        {"downhill_rad", "rad", &FloorSlope::downhill_rad, Bounds::between(-3.2, 3.2), 0, 3.14, 1}},
                       {"Non-systematic: external forces (gravity)", "Lecture 7.3",
                        "The floor is tilted against gravity; acts through creep, load or sliding.",
                        "a direction of the floor", "carpet_drift"}),
      line<CarpetDrift>(
          "carpet_drift", Stage::floor,
          {{"metres_per_metre", "1", &CarpetDrift::metres_per_metre, Bounds::between(0, 0.5), 0.002, 0.03, 0.004},
           {"direction_rad", "rad", &CarpetDrift::direction_rad, Bounds::between(-3.2, 3.2), 0, 3.14, 0.8}},
          {"Non-systematic: external forces", "Pile of a carpet",
           "Wheels are carried sideways in proportion to the distance they roll.",
           "a direction of the floor, both directions alike", "floor_slope"}),
      line<PushEffect>(
          "push", Stage::floor,
          {{"leg", "1", &PushEffect::leg, Bounds::between(1, 4000), 1, 4, 2},
           {"seconds_into_leg", "s", &PushEffect::seconds_into_leg, Bounds::between(0, 1000000.0), 0, 20, 6},
           {"impulse_newton_seconds", "N s", &PushEffect::impulse_newton_seconds, Bounds::between(-100000.0, 100000.0),
            5, 100, 30},
           {"direction_rad", "rad", &PushEffect::direction_rad, Bounds::between(-3.2, 3.2), 0, 3.14,
            PushEffect{}.direction_rad},
           {"ahead_m", "m", &PushEffect::ahead_m, Bounds::between(-5, 5), 0, 0.3, PushEffect{}.ahead_m},
           {"duration_s", "s", &PushEffect::duration_s, {0, 60, true}, 0.02, 1, PushEffect{}.duration_s}},
          {"Non-systematic: external forces", "Lecture 7.3",
           "Someone pushes the robot during one leg, of one run if `run` names it.", "one run, one moment", "bump"}),
      line<WheelLift>("wheel_lift", Stage::floor,
                      {{"x_m", "m", &WheelLift::x_m, Bounds{}, 0, 4, 0.05},
                       {"y_m", "m", &WheelLift::y_m, Bounds{}, 0, 4, -0.17},
                       {"length_m", "m", &WheelLift::length_m, Bounds::between(0, 100), 0.005, 0.1, 0.1}},
                      {"Non-systematic: no point contact between wheel and floor", "Lecture 7.3",
                       "A stretch where a wheel is carried by something that gives no traction.",
                       "a place; one wheel turns for nothing", "slippery_patch"}),
  };
  return table;
}

}  // namespace umbsim
