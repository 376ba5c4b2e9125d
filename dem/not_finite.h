// Numbers that are none, such as overflow and division by zero leave behind: whether particles hold any, and
// whose they are. Looked for seldom, so that no loop over forces has to.
#pragma once

#include <stdexcept>
#include <string>

#include "dem/particles.h"

namespace platen::dem {

// Thrown where a search meets a centre that is not finite; Problem says then whose it is.
class NotFinite : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

// Whether position, velocity and, with rotation, orientation and angular velocity of all are finite.
bool motion_is_finite(const Particles &particles);

// Where numbers are not finite, as a message says it: "velocity of particle 17", "position, velocity of
// particles 3, 17 and 5 more". Ids are those of the input. Empty where all are finite. Looks at every column
// of numbers.
std::string not_finite(const Particles &particles);

} // namespace platen::dem
