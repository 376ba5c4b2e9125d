// The number pi, to the last bit of a double, and a degree in radians.
#pragma once

namespace platen {

constexpr double pi = 3.14159265358979323846, degree = pi / 180;

} // namespace platen
