// The number pi, to the last bit of a double.
#pragma once

namespace platen {

constexpr double pi = 3.14159265358979323846;

} // namespace platen
