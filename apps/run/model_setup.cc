#include "apps/run/model_setup.h"

#include "apps/output/specimen_csv.h"
#include "apps/scene/bond_file.h"
#include "apps/scene/program.h"

namespace platen::apps {

dem::ModelSettings model_settings(const Scene &scene) {
  dem::ModelSettings to = model_without_files(scene);
  if (scene.phases.by == PhasesBy::file) to.phases->aggregate_ids = read_id_list(scene.phases.file);
  const SpecimenSection &specimen = scene.specimen;
  const bool from_file = scene.program->packs && specimen.packing == PackingKind::file;
  if (!from_file || specimen.bond_file.empty() || !scene.bond.bonded()) return to;
  SpecimenForm form = specimen.form;
  form.with_ids = true;
  to.bond_choice.given =
      read_bond_file(specimen.bond_file, read_specimen_file(specimen.file, form), to.bond_layout);
  return to;
}

} // namespace platen::apps
