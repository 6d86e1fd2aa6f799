#pragma once

#include <optional>
#include <string>
#include <vector>

#include "odometry/dead_reckoning.h"
#include "recording/recording.h"

namespace umbsim {

/// Return error of one run: absolute minus calculated pose, in the frame of the start pose
/// (x along the start heading, y left).
struct ReturnError {
  std::string run;
  double x_m = 0;
  double y_m = 0;
  double theta_rad = 0;
  int laps = 1;  ///< squares that the run is: whole turns of the calculated heading
};

/// The end points of one direction.
struct Cluster {
  std::vector<ReturnError> errors;
  double centroid_x_m = 0;
  double centroid_y_m = 0;
  double heading_rad = 0;
  double r_cg_m = 0;  ///< distance of the centroid from the origin: the systematic part
  double sd_x_m = 0;  ///< sample standard deviations: the non-systematic part; 0 for one run
  double sd_y_m = 0;
  double sd_heading_rad = 0;
  double sd_m = 0;              ///< sqrt((sd_x^2 + sd_y^2) / 2), the spread along any one axis
  double standard_error_m = 0;  ///< of the centroid along one axis: sd_m / sqrt(runs)
  double laps = 1;              ///< of a run, on the mean
};

/// One estimate of the two dominant systematic errors.
struct ErrorEstimate {
  double alpha_rad = 0;     ///< type A error of each turn: same sense in both directions, from the wheelbase
  double beta_rad = 0;      ///< type B error of each leg: opposite senses, from unequal diameters
  double e_d = 1;           ///< D_R / D_L
  double e_b = 1;           ///< b_actual / b_nominal
  double left_factor = 1;   ///< c_L = 2 / (E_d + 1)
  double right_factor = 1;  ///< c_R = 2 / (1/E_d + 1)
};

/// The two-way test (Borenstein & Feng 1995).
struct Umbmark {
  Cluster cw;
  Cluster ccw;
  double e_max_syst_m = 0;   ///< max(r_cg,cw, r_cg,ccw)
  ErrorEstimate endpoint;    ///< from the return positions, small-angle (Borenstein & Feng 1996)
  ErrorEstimate endpoint_y;  ///< the same from the y coordinates: the cross-check
  ErrorEstimate heading;     ///< from the return headings (Jung & Chung's idea), exact
  double type_a_share = 0;   ///< |alpha| / (|alpha| + |beta|), heading form; 0 if both vanish
  double type_b_share = 0;
};

/// How much of the return position errors comes again in every run, and how much does not. The mean square error is
/// the sum of both squares, exactly: rms^2 = systematic^2 + non_systematic^2.
struct ErrorShares {
  double rms_m = 0;             ///< of the distances between absolute and calculated end point
  double systematic_m = 0;      ///< r_cg: what calibration can remove
  double non_systematic_m = 0;  ///< rms distance of the end points from their centroid
  double systematic = 0;        ///< shares of the mean square error; both 0 if there is no error
  double non_systematic = 0;
};

/// Extended UMBmark (Borenstein 1994).
struct ExtendedUmbmark {
  Cluster cw;  ///< of the bumped runs
  Cluster ccw;
  double cw_mean_abs_heading_error_rad = 0;  ///< mean |e_theta - plain mean|
  double ccw_mean_abs_heading_error_rad = 0;
  double mean_abs_heading_error_rad = 0;  ///< the sum of both
  double per_bump_heading_error_rad = 0;  ///< mean per direction and bump; 0 if the number of bumps is unknown
};

/// Return errors of the runs of one direction, plain or bumped. Odometry is computed from the ticks.
/// Throws InputError if a run has no truth.
std::vector<ReturnError> return_errors(const Recording& recording, const OdometryParameters& odometry,
                                       const std::string& direction, bool bumped);

ReturnError return_error(const RecordedRun& run, const OdometryParameters& odometry);
/// From the absolute and the calculated pose at its end, in the frame of its start.
ReturnError return_error(const std::string& run, const Pose2& absolute, const Pose2& calculated);

/// A run with cables.
bool is_bumped(const RecordedRun& run);
/// Cables of a bumped run, the most of all; 0: not known.
int bump_count(const Recording& recording);

Cluster cluster(std::vector<ReturnError> errors);

ErrorShares error_shares(const Cluster& cluster);
/// Of all runs of several directions together, each direction weighing the same. One run of a direction has no spread.
ErrorShares error_shares(const std::vector<ErrorShares>& directions);

/// Square runs only. `nominal_wheelbase_m` is the odometry's. Of runs of several laps each lap has its share of the
/// return error: of headings exactly, of positions to first order. Throws std::invalid_argument if a direction is
/// empty.
Umbmark umbmark(Cluster cw, Cluster ccw, double side_m, double nominal_wheelbase_m);

/// (docs: recorded runs without bumps, both directions.) Throws InputError if the recording is not a square, or lacks a
/// direction.
Umbmark umbmark(const Recording& recording, const OdometryParameters& odometry);

/// Empty if the recording has no bumped runs of both directions.
std::optional<ExtendedUmbmark> extended_umbmark(const Recording& recording, const OdometryParameters& odometry,
                                                const Umbmark& plain);

/// Of both directions' bumped runs, neither of them empty.
ExtendedUmbmark extended_umbmark(Cluster cw, Cluster ccw, const Umbmark& plain, int bumps);

/// E_d and E_b from alpha and beta by Borenstein & Feng's formulas (small-angle where alpha and beta come from return
/// positions).
ErrorEstimate error_estimate(double alpha_rad, double beta_rad, double side_m, double wheelbase_m);

/// The same from return headings: exact for robots that drive legs and in-place turns.
ErrorEstimate heading_estimate(double alpha_rad, double beta_rad, double side_m, double wheelbase_m);

}  // namespace umbsim
