// Cases of the studies of platens: what faces the specimen, and how slender it is.
#pragma once

#include "apps/scene/scene.h"
#include "apps/study/cases.h"

namespace platen::apps {

// Platens x slendernesses x sphere radii x pressures of the scene's section Study; a list that is empty
// leaves what the scene has. A specimen of another height is packed anew with the same recipe, spheres, width
// and seed, and pressed at the same speed: so many wave crossings to the same strain, whatever the height.
// Throw InputError where there is nothing to vary or the scene contradicts it.
StudyPlan plan_friction(const Scene &scene);
StudyPlan plan_slenderness(const Scene &scene); // one kind of platens

// Fills StudyCase::surface and labels from the scene that the case leads to.
void label_platens(StudyCase &of, const Scene &led_to);

// Height over width, the smaller one of a box.
double slenderness(const SpecimenSection &specimen);

} // namespace platen::apps
