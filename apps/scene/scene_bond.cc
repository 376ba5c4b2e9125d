#include "apps/scene/scene_bond.h"

#include <cmath>
#include <stdexcept>

#include "base/portable.h"

namespace platen::apps {
namespace {

// use(value) of the member of that name, if it is of that type.
template <class Value, class Parameters, class Use>
void find_member(Parameters &of, const std::string &wanted, const Use &use) {
  std::decay_t<Parameters>::describe(
      [&](const char *name, auto &value, const auto &.../*about*/) {
        if constexpr (std::is_same_v<std::decay_t<decltype(value)>, Value>)
          if (name == wanted) use(value);
      },
      of);
}
template <class Parameters, class Use>
void find_number(Parameters &of, const std::string &wanted, const Use &use) {
  find_member<double>(of, wanted, use);
}

} // namespace

std::optional<dem::BondParameters> Bond::parameters() const {
  if (!bonded()) return std::nullopt;
  return dem::BondLaws::chosen<dem::BondParameters>(laws, static_cast<std::size_t>(law));
}

bool Bond::remembers() const {
  return bonded() &&
         dem::BondLaws::holds(static_cast<std::size_t>(law), [](auto *of) { return of->has_history; });
}

bool Bond::bonds_by_range() const {
  return bonded() &&
         dem::BondLaws::holds(static_cast<std::size_t>(law), [](auto *of) { return of->bonds_by_range; });
}

bool Bond::has(const std::string &member) const {
  bool found = false;
  const auto use = [&](const double &) { found = true; };
  if (bonded()) std::visit([&](const auto &of) { find_number(of, member, use); }, *parameters());
  return found;
}

double Bond::number(const std::string &member) const {
  std::optional<double> found;
  const auto use = [&](const double &number) { found = found.value_or(number); };
  std::apply([&](const auto &...of) { (find_number(of, member, use), ...); }, laws);
  if (!found) throw std::logic_error("no bond has " + member);
  return *found;
}

void Bond::set(const std::string &member, double value) {
  const auto use = [&](double &number) { number = value; };
  std::apply([&](auto &...of) { (find_number(of, member, use), ...); }, laws);
}

std::vector<double> Bond::list(const std::string &member) const {
  std::vector<double> found;
  const auto use = [&](const std::vector<double> &values) { found = values; };
  if (bonded())
    std::visit([&](const auto &of) { find_member<std::vector<double>>(of, member, use); }, *parameters());
  return found;
}

void Bond::set(const std::string &member, const std::vector<double> &values) {
  const auto use = [&](std::vector<double> &list) { list = values; };
  std::apply([&](auto &...of) { (find_member<std::vector<double>>(of, member, use), ...); }, laws);
}

Bond Bond::for_size(double share) const {
  Bond to = *this;
  if (!(size.reference > 0)) return to;
  const double factor = portable::pow(share, size.strength_exponent);
  for (const char *strength : {"tensile_strength", "shear_strength"})
    to.set(strength, factor * number(strength)); // of all laws: the same number
  std::vector<double> limits = list("compression_limits");
  for (double &limit : limits)
    limit *= factor;
  if (!limits.empty()) to.set("compression_limits", limits);
  return to;
}

} // namespace platen::apps
