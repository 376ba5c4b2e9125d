// Closed lists of laws: what follows from the names of its laws alone. A law has a word, and Parameters that
// describe themselves (base/describe.h).
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <tuple>
#include <utility>
#include <variant>
#include <vector>

#include "base/describe.h"

namespace platen::dem {

template <class... Laws>
struct LawList {
  using Law = std::variant<Laws...>;
  using Parameters = std::variant<typename Laws::Parameters...>;
  using AllParameters = std::tuple<typename Laws::Parameters...>;

  static constexpr std::size_t size = sizeof...(Laws);
  static constexpr std::array<const char *, size> words{Laws::word...};

  // f(Law *) of each law, null pointers that carry the type.
  template <class F>
  static void for_each(F &&f) {
    (f(static_cast<Laws *>(nullptr)), ...);
  }
  // Words of the laws of which has(Law *) says yes.
  template <class Has>
  static std::vector<std::string> words_where(const Has &has) {
    std::vector<std::string> of;
    for_each([&](auto *law) {
      if (has(law)) of.emplace_back(std::remove_pointer_t<decltype(law)>::word);
    });
    return of;
  }
  // has(Law *) of the law in this place.
  template <class Has>
  static bool ask(std::size_t place, const Has &has) {
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
  // Those of the law in this place.
  static Parameters chosen(const AllParameters &all, std::size_t place) {
    return chosen(all, place, std::index_sequence_for<Laws...>());
  }
  // The law of these parameters. Throws BadParameter.
  static Law law(const Parameters &parameters) { return law(parameters, std::index_sequence_for<Laws...>()); }

private:
  template <std::size_t... k>
  static Parameters chosen(const AllParameters &all, std::size_t place, std::index_sequence<k...>) {
    Parameters found;
    ((k == place ? (void)found.template emplace<k>(std::get<k>(all)) : void()), ...);
    return found;
  }
  template <std::size_t... k>
  static Law law(const Parameters &parameters, std::index_sequence<k...>) {
    Law found;
    ((parameters.index() == k ? (void)found.template emplace<k>(checked(std::get<k>(parameters))) : void()),
     ...);
    return found;
  }
  template <class One>
  static const One &checked(const One &parameters) {
    require_in_range(parameters);
    return parameters;
  }
};

} // namespace platen::dem
