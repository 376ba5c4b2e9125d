// The fields of all frames as files for ParaView.
#pragma once

#include <filesystem>

#include "apps/report/run_folder.h"

namespace platen::apps::report {

// Writes fields.pvd and frames/fields_*.vti into the run's folder: on one grid through platens and specimen,
// nodes a mean radius apart, `stress` (Pa, tension positive; in deformable platens too), `strain`,
// `displacement` (m), `damage`, `solid_share`, and `body` (0 nothing, 1 specimen, 2 platen) to choose by.
// Numbers that a node has not are NaN. The run must tell stress (field_frame.h). Returns fields.pvd. Throws
// InputError, OutputError.
std::filesystem::path write_fields(const Run &run);

} // namespace platen::apps::report
