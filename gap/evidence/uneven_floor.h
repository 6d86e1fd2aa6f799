#pragma once

#include <optional>

#include "gap/evidence/model.h"

namespace umbsim::gap {

/// The effect of the catalogue.
inline constexpr const char* kUnevenFloor = "uneven_floor";

/// An uneven floor found in what a fit leaves. A robot on a slope stands off the place where its wheels touch, by the
/// axle's height times the slope; so the floor shifts it by the same vector whenever it passes, whichever way it goes.
struct UnevenFloorFound {
  /// Of the agreement between passes in different directions over its standard error: of whole shifts, or of what is
  /// across the way, whichever is more.
  double sigmas = 0;
  double rms_m = 0;  ///< of the floor's height
  double wavelength_m = 0;
  double log_sd[2] = {0, 0};  ///< of both, by leaving out runs in turn; the height is unsure by more
};

/// Looks at the shifts along the legs where runs pass the same place in different directions. Nothing where no run
/// does, or where passes do not agree.
std::optional<UnevenFloorFound> find_uneven_floor(const Model& model, const Fit& fit);

/// Whether what a fit leaves shifts the robot alike whenever it passes the same place the same way, and no run passes
/// it another way: then these runs cannot tell a floor from what else repeats.
bool may_be_uneven_floor(const Model& model, const Fit& fit);

/// The fit with an uneven floor of these numbers beside its effects. The floor's shape is not fitted: the prediction
/// stays as it is.
Fit on_uneven_floor(Fit fit, const UnevenFloorFound& floor);

}  // namespace umbsim::gap
