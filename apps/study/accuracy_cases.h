// Cases of the study of accuracy: what trades accuracy for time, one thing at a time.
#pragma once

#include "apps/scene/scene.h"
#include "apps/study/cases.h"

namespace platen::apps {

// A case for each value of each list of the section Study that such a study knows, all else as the scene has
// it; what the scene has itself is one case, `base`, whichever lists hold it. Lists go from coarse to fine,
// their last value is the reference of the others; that of Study/Effects list is the scene as it is. Throws
// InputError where nothing is varied, a list goes the wrong way, or the scene contradicts it.
StudyPlan plan_accuracy(const Scene &scene);

// Fills StudyCase::labels from the scene that the case leads to.
void label_knobs(StudyCase &of, const Scene &led_to);

} // namespace platen::apps
