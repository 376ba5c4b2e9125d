// Conversion of vectors to Eigen, for matrices and linear solves.
#pragma once

#include <Eigen/Core>

#include "base/vector3.h"

namespace platen::dem {

inline Eigen::Vector3d eigen(const Vector3 &v) {
  return {v.x, v.y, v.z};
}

} // namespace platen::dem
