// Normal force laws between grains that touch without a bond, one law for all contacts. A law is a header, a
// name in NormalContact and an entry in the list below.
#pragma once

#include <stdexcept>
#include <type_traits>

#include "base/describe.h"
#include "dem/laws/hertz_contact.h"
#include "dem/laws/linear_contact.h"

namespace platen::dem {

template <class... Laws>
struct NormalContactList {
  static Words<NormalContact> words() { return {{Laws::word, Laws::kind}...}; }

  // f(law) for the chosen law.
  template <class F>
  static auto with(NormalContact chosen, const F &f) {
    std::common_type_t<decltype(f(Laws()))...> result{};
    if (!(... || (Laws::kind == chosen && ((result = f(Laws())), true))))
      throw std::logic_error("a law of contacts is not in the list");
    return result;
  }
};
using NormalContacts = NormalContactList<LinearContact, HertzContact>;

inline const char *word(NormalContact law) {
  return NormalContacts::with(law, [](auto of) { return of.word; });
}

} // namespace platen::dem
