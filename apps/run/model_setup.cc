#include "apps/run/model_setup.h"

#include "apps/output/specimen_csv.h"

namespace platen::apps {

dem::ModelSettings model_settings(const Scene &scene) {
  dem::ModelSettings to = model_without_files(scene);
  if (scene.phases.by == PhasesBy::file) to.phases->aggregate_ids = read_id_list(scene.phases.file);
  return to;
}

} // namespace platen::apps
