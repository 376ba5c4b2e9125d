#include "apps/scene/scene_bond.h"

#include <stdexcept>

namespace platen::apps {
namespace {

// Hands the number of that name to `use`.
template <class Use>
struct OneNumber {
  const std::string &name;
  const Use &use;
  template <class Number, class... Rest>
  void operator()(const char *member, Number &number, const Rest &...) const {
    if constexpr (std::is_same_v<std::decay_t<Number>, double>)
      if (member == name) use(number);
  }
};

template <class Laws, class Use>
void each_number(Laws &laws, const std::string &member, const Use &use) {
  std::apply(
      [&](auto &...of) {
        (std::decay_t<decltype(of)>::describe(OneNumber<Use>{member, use}, of), ...);
      },
      laws);
}

} // namespace

std::optional<dem::BondParameters> Bond::parameters() const {
  if (!bonded()) return std::nullopt;
  return dem::BondLaws::chosen(laws, static_cast<std::size_t>(law));
}

bool Bond::remembers() const {
  return bonded() &&
         dem::BondLaws::ask(static_cast<std::size_t>(law), [](auto *of) { return of->has_history; });
}

bool Bond::bonds_by_range() const {
  return bonded() &&
         dem::BondLaws::ask(static_cast<std::size_t>(law), [](auto *of) { return of->bonds_by_range; });
}

bool Bond::has(const std::string &member) const {
  if (!bonded()) return false;
  bool found = false;
  const auto use = [&](const double &) { found = true; };
  std::visit([&](const auto &of) { of.describe(OneNumber<decltype(use)>{member, use}, of); }, *parameters());
  return found;
}

double Bond::number(const std::string &member) const {
  std::optional<double> found;
  each_number(laws, member, [&](const double &number) { found = found.value_or(number); });
  if (!found) throw std::logic_error("no bond has " + member);
  return *found;
}

void Bond::set(const std::string &member, double value) {
  each_number(laws, member, [&](double &number) { number = value; });
}

} // namespace platen::apps
