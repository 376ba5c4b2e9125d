// What a run says of its loading stages: what each asked and reached.
#pragma once

#include "apps/output/summary.h"
#include "apps/run/test_record.h"

namespace platen::apps {

// Of those that the scene writes: where each ended, by what, and what it asked and reached. The one that a
// run was in when it stopped ended by "stopped", or by "stop at residual".
Json stages_of(const TestRecord &test);

// Of a test whose scene writes none: what was asked and reached, by the names of its stages. Each is
// quantity, side, asked, reached, unit, met (within 1 %), as it is now or was at the end of its stage.
Json controls_of(const TestRecord &test);

} // namespace platen::apps
