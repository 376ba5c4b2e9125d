// What cannot be of a test, by its settings alone: each rule once, for programs that read a file and for
// PlatenTest itself, before anything is packed.
#pragma once

#include <string>
#include <vector>

#include "coupling/platen_test_settings.h"
#include "dem/packing/specimen.h"

namespace platen::coupling {

// A member of the settings that cannot be what it is. Texts name other members in backquotes; what is allowed
// stands at the end.
struct Fault {
  std::string member; // "loading.start_strain"
  std::string reason; // goes after the member, or after the value that a file gives it
};

// All faults of the settings, one for each rule that is broken. `shape` is the specimen's; null: it is not
// known yet, and what depends on it is not looked at.
std::vector<Fault> faults(const PlatenTestSettings &settings, const dem::Shape *shape);

// Throws BadSetup for the first of them.
void require_no_fault(const PlatenTestSettings &settings, const dem::Shape &shape);

} // namespace platen::coupling
