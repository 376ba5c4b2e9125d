// Vectors as Eigen has them, for matrices and what is solved with them.
#pragma once

#include <Eigen/Core>

#include "base/vector3.h"

namespace platen::dem {

inline Eigen::Vector3d eigen(const Vector3 &v) {
  return {v.x, v.y, v.z};
}

} // namespace platen::dem
