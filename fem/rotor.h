// Matrices of inertia and of rotational stiffness, for bodies that rotate rigidly about a point.
#pragma once

#include "base/vector3.h"

namespace platen::fem {

Matrix3 inverse(const Matrix3 &a);
Matrix3 operator*(const Matrix3 &a, const Matrix3 &b);

// Adds weight (r^2 1 - r r^T), the moment of `weight` at r about the origin. A mass (kg) gives inertia (kg
// m^2), a spring with the same stiffness in all directions (N/m) a rotational stiffness (N m/rad).
void add_about_origin(Matrix3 &sum, double weight, const Vector3 &r);

// Largest eigenvalue of the product of two symmetric matrices without negative eigenvalues, such as
// inertia^-1 stiffness (1/s^2): its eigenvalues are real, roots of a cubic.
double largest_eigenvalue(const Matrix3 &product);

} // namespace platen::fem
