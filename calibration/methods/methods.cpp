#include "calibration/methods/methods.h"

#include "calibration/methods/jackknife.h"
#include "calibration/methods/likelihood/likelihood.h"
#include "calibration/methods/paths/circles.h"
#include "calibration/methods/paths/kelly.h"
#include "calibration/methods/paths/least_squares.h"
#include "calibration/methods/squares/squares.h"

namespace umbsim::calibration {

const std::vector<Method>& methods() {
  static const std::vector<Method> all = {
      {"endpoint", "UMBmark, return positions", "Borenstein & Feng 1996",
       "the start heading; small angles; closed squares; the same error in every turn and leg", "the mean radius",
       fit_endpoint},
      {"iterated", "UMBmark, repeated on the ticks", "Borenstein & Feng 1996, repeated",
       "the start heading; the same error in every turn and leg", "the mean radius", fit_iterated_endpoint},
      {"heading", "return headings", "after Jung & Chung 2011",
       "start and return headings; the same error in every turn and leg", "the mean radius", fit_heading},
      {"circles", "bidirectional circles", "after Abbas, Arif & Ahmed 2006",
       "steady circles; the tracked point above the axle's middle",
       "errors of turns in place; with end points only, the mean radius", fit_circles},
      {"least-squares", "least squares on any path", "Antonelli, Chiaverini & Fusco 2005; Antonelli & Chiaverini 2007",
       "tracked headings and clocks; every piece of a path weighs by its length", "tracker and clock errors",
       fit_least_squares},
      {"kelly", "linearised path integrals", "Kelly 2004", "clocks; the marker above the axle's middle",
       "clock and marker errors; with end points of closed paths only, the mean radius", fit_kelly},
      {"likelihood", "maximum likelihood on whole tracks", "Kalman innovations; Ceres",
       "white tracker noise, random walk of the wheels; one radius and wheelbase throughout",
       "with end points only: tracker frame, marker and clock; of closed paths, the mean radius", fit_likelihood},
      {"scrub", "the same, with tyres that creep against turning", "Kalman innovations; Ceres",
       "white tracker noise, random walk of the wheels; a moment against turning that does not depend on speed",
       "scrub beside the wheelbase, where turns in place or arcs of one radius are all there is", fit_scrub}};
  return all;
}

Fit fit_with(const Method& method, const Runs& runs, const OdometryParameters& nominal) {
  return with_interval(method.fit, runs, nominal);
}

}  // namespace umbsim::calibration
