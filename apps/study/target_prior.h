// By what runs of a figure are expected to differ before there are any.
#pragma once

#include "apps/study/study_section.h"
#include "apps/study/target_model.h"

namespace platen::apps {

// `spheres`: of a run.
SpreadPrior expected_spread(TargetFigure figure, double spheres);

// b of 1.5, above all that docs/accuracy.md measured.
RunErrors expected_errors(TargetFigure figure, double spheres);

} // namespace platen::apps
