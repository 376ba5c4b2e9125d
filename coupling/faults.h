// Rules on the settings of a test that need the settings alone: each rule once, for programs that read a file
// and for PlatenTest itself, before anything is packed.
#pragma once

#include <string>
#include <vector>

#include "coupling/platen_test_settings.h"
#include "dem/packing/specimen.h"

namespace platen::coupling {

// A member of the settings with a value that is not allowed. Texts name other members in backquotes; the
// allowed values are at the end.
struct Fault {
  std::string member; // "loading.start_strain"
  std::string reason; // follows the member, or the value that a file gives it
};

// All faults of the settings, one for each rule that is broken. `shape` is the specimen's; null: it is not
// known yet, and rules that depend on it are skipped.
std::vector<Fault> faults(const PlatenTestSettings &settings, const dem::Shape *shape);

// Throws BadSetup for the first fault.
void require_no_fault(const PlatenTestSettings &settings, const dem::Shape &shape);

} // namespace platen::coupling
