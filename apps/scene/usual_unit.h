// Numbers as engineers name them: stresses in MPa, lengths in mm.
#pragma once

#include <array>
#include <cstdio>
#include <string>

namespace platen::apps {

// The unit in which a number of this SI unit is named, and how much of that is one of it; as it is for
// others.
struct UsualUnit {
  std::string name;
  double in_one = 1;
};
inline UsualUnit usual_unit(const std::string &si_unit) {
  if (si_unit == "Pa") return {"MPa", 1e-6};
  if (si_unit == "m") return {"mm", 1e3};
  return {si_unit, 1};
}

// "1.4 mm" of 0.0014 m, without the last bit that a conversion may leave. `between` parts number and unit.
inline std::string in_usual_unit(double value, const std::string &si_unit, const std::string &between = " ") {
  const UsualUnit unit = usual_unit(si_unit);
  std::array<char, 40> number{};
  std::snprintf(number.data(), number.size(), "%.12g", value * unit.in_one);
  return number.data() + (unit.name.empty() ? "" : between + unit.name);
}

} // namespace platen::apps
