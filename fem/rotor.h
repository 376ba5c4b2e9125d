// Of bodies that turn as one about a point: their matrices of inertia and of turning springs.
#pragma once

#include "base/vector3.h"

namespace platen::fem {

Matrix3 inverse(const Matrix3 &a);
Matrix3 operator*(const Matrix3 &a, const Matrix3 &b);

// Adds what `weight` at the place r has about the origin: weight (r^2 1 - r r^T). A mass (kg) gives inertia
// (kg m^2), a spring that is alike in all directions (N/m) the stiffness of a turn (N m/rad).
void add_about_origin(Matrix3 &sum, double weight, const Vector3 &r);

// Of the product of two symmetric matrices without negative eigenvalues, such as inertia^-1 stiffness
// (1/s^2): its eigenvalues are real, roots of a cubic.
double largest_eigenvalue(const Matrix3 &product);

} // namespace platen::fem
