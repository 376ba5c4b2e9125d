// Stress, strain and damage through specimen and platens on one grid: in one frame, as files for ParaView of
// all frames, and as a picture.
#pragma once

#include <vtkImageData.h>
#include <vtkSmartPointer.h>

#include <filesystem>
#include <vector>

#include "apps/report/run_folder.h"
#include "dem/measure/coarse_grain.h"

namespace platen::apps::report {

enum class Body : unsigned char { outside, specimen, platen };

struct FieldFrame {
  double time = 0; // s, of the frame of the specimen
  dem::RegularGrid grid;
  dem::CoarseFields fields; // not a number outside; in platens the stress alone, where they are deformable
  std::vector<Body> body;
};

// Whether the run says what is needed: frames with stress, contacts, and the packing fraction.
bool tells_stress(const Run &run);

// The spheres of the frame nearest to `time` with the forces of platens and sleeve added to their stress as
// those of bonds are: arm times force over the sphere's volume and its share of the voids. Throws InputError
// where a field is missing.
dem::SphereColumns stressed_spheres(const Run &run, double time);

// `reach`: of the averages, m. Where the solid share is a third of what dense packings have or
// more is specimen: half of it is at a flat surface.
FieldFrame field_frame(const Run &run, double time, const dem::RegularGrid &grid, double reach);

// The same points for VTK, without data.
vtkSmartPointer<vtkImageData> image_of(const dem::RegularGrid &grid);

// m; what lengths of averages and grids go by.
double mean_radius(const Spheres &spheres);

// Writes fields.pvd and frames/fields_*.vti into the run's folder: on one grid through platens and specimen,
// nodes a mean radius apart, `stress` (Pa, tension positive; in deformable platens too), `strain`,
// `displacement` (m), `damage`, `solid_share`, and `body` (0 nothing, 1 specimen, 2 platen) to choose by.
// Numbers that a node has not are NaN. The run must tell stress. Returns fields.pvd. Throws
// InputError, OutputError.
std::filesystem::path write_fields(const Run &run);

// Vertical stress and largest shear in the plane y = 0, from platen through specimen to platen, in the frame
// nearest to the peak; platens that are rigid in grey. The run must tell stress. Needs an X server
// (display.h); throws OutputError where the file cannot be written.
void draw_stress_flow(const Run &run, const Spheres &before_test, const std::filesystem::path &png);

} // namespace platen::apps::report
