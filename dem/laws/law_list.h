// Closed lists of laws: functions that follow from the list of laws alone. A law has a word, and Parameters
// that describe themselves (base/describe.h).
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <tuple>
#include <type_traits>
#include <variant>
#include <vector>

#include "base/describe.h"

namespace platen::dem {

template <class... Laws>
struct LawList {
  using Law = std::variant<Laws...>;
  using Parameters = std::variant<typename Laws::Parameters...>;
  using AllParameters = std::tuple<typename Laws::Parameters...>;

  // The same list with one more law.
  template <class More>
  using With = LawList<Laws..., More>;

  static constexpr std::size_t size = sizeof...(Laws);
  static constexpr std::array<const char *, size> words{Laws::word...};

  // Calls f(Law *) for each law, with null pointers that carry the type.
  template <class F>
  static void for_each(F &&f) {
    (f(static_cast<Laws *>(nullptr)), ...);
  }
  // Words of the laws for which has(Law *) is true.
  template <class Has>
  static std::vector<std::string> words_where(const Has &has) {
    std::vector<std::string> of;
    for_each([&](auto *law) {
      if (has(law)) of.emplace_back(std::remove_pointer_t<decltype(law)>::word);
    });
    return of;
  }
  // has(Law *) for the law at this place.
  template <class Has>
  static bool holds(std::size_t place, const Has &has) {
    std::size_t k = 0;
    bool yes = false;
    for_each([&](auto *law) { yes = yes || (k++ == place && has(law)); });
    return yes;
  }
  template <class One>
  static constexpr std::size_t place() {
    constexpr std::array<bool, size> is{std::is_same_v<One, Laws>...};
    std::size_t k = 0;
    while (!is[k])
      ++k;
    return k;
  }
  // Parameters of the law at this place.
  template <class Of = Parameters>
  static Of chosen(const AllParameters &all, std::size_t place) {
    Of found;
    std::size_t k = 0;
    ((k++ == place ? (void)(found = std::get<typename Laws::Parameters>(all)) : void()), ...);
    return found;
  }
  // The law with these parameters. Throws BadParameter.
  static Law law(const Parameters &parameters) {
    Law found;
    std::size_t k = 0;
    ((parameters.index() == k++ ? (void)(found = made<Laws>(parameters)) : void()), ...);
    return found;
  }

private:
  template <class One>
  static One made(const Parameters &of) {
    const auto &parameters = std::get<typename One::Parameters>(of);
    require_in_range(parameters);
    return One(parameters);
  }
};

} // namespace platen::dem
