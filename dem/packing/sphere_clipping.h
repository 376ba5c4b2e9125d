// How much of a sphere lies inside a shape. SI units.
#pragma once

#include "base/vector3.h"
#include "dem/packing/specimen.h"

namespace platen::dem {

// Volume (m^3) of the part of a sphere inside the shape. Spheres wholly inside are exact; cut ones are
// integrated over slices along z (closed form for a disc cut by the circle of a cylinder, Gauss points for a
// rectangle), with an error below 1e-4 of the sphere.
double clipped_volume(const Vector3 &centre, double radius, const Shape &shape);

// Area (m^2) of the part two discs share; distance of their centres in m.
double shared_area_of_discs(double radius_a, double radius_b, double distance);

} // namespace platen::dem
