#pragma once

#include <Eigen/Core>
#include <vector>

#include "gap/evidence/model.h"

namespace umbsim::gap {

/// What a recording says of by how much the signature of the effect that is in it is off, piece by piece: as shares of
/// what the effect does in a part of the course, in runs of one condition, and, last, of what counts show of it.
struct SignatureShares {
  std::vector<std::size_t> part;  ///< a CoursePart of each piece; kCourseParts: of the counts
  Eigen::MatrixXd precision;      ///< of the shares, by the data alone
  Eigen::VectorXd pull;           ///< precision times the likeliest shares
  double log_density = 0;         ///< of the data, if no piece is off

  /// Log density that the data gain, if the pieces are off by these standard deviations.
  double gain(const Eigen::VectorXd& sd) const;
};

/// `fit`: of a single effect; its numbers are held. `motion`: as SignatureErrors::motion.
SignatureShares signature_shares(const Model& model, const Fit& fit, double motion);

}  // namespace umbsim::gap
