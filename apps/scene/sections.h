// The table of everything that a scene file may say, by sections; each is bound to its struct of the scene.
#pragma once

#include <array>
#include <vector>

#include "apps/scene/declare.h"
#include "apps/scene/scene.h"

namespace platen::apps {

void declare_specimen(Parameters &parameters, SpecimenSection &specimen);
void declare_material(Parameters &parameters, dem::ModelSettings &model, dem::ContactSettings &contact);
void declare_effects(Parameters &parameters, Scene &scene);
void declare_bond(Parameters &parameters, Bond &bond, dem::ModelSettings &model);
void declare_phases(Parameters &parameters, PhasesSection &phases);
void declare_contact(Parameters &parameters, dem::ContactSettings &contact);
void declare_platens(Parameters &parameters, Platens &platens, coupling::LoadingSettings &loading);
void declare_sleeve(Parameters &parameters, Loading &loading);
void declare_loading(Parameters &parameters, Loading &loading);
void declare_stages(Parameters &parameters, std::array<StageSection, most_stages> &stages);
void declare_expect(Parameters &parameters, std::vector<Expectation> &expect);

} // namespace platen::apps
