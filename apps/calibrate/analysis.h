// What the sensitivities at the best trial say of parameters and targets.
#pragma once

#include <string>
#include <vector>

#include "apps/calibrate/search.h"

namespace platen::apps {

struct Analysis {
  // d ln goal / d ln parameter, a row a parameter, a column a wanted goal; of a curve the root mean square
  // over its points of d(stress over the largest) / d ln parameter.
  Eigen::MatrixXd sensitivities;
  // Of the parameters, from the inverse of J^T J (Gauss-Newton), J the slopes of the responses.
  Eigen::MatrixXd correlations;
  // "tensile strength against shear strength (-0.98)": pairs that only differences tell apart.
  std::vector<std::string> correlated;
  // "tensile strength +0.71, shear strength +0.71": changes by half along which no goal moves by its
  // tolerance.
  std::vector<std::string> undetermined;
  // Of the goals beyond their tolerance: what was wanted, the nearest, and which goal pulls against it: with
  // g = J^T r of each goal's own rows, whose sum is zero where the search rests, that with the most negative
  // product with its g.
  std::vector<std::string> missed;
};
Analysis analyse(const Goals &goals, const Found &found);

} // namespace platen::apps
