// The pictures of a report, one function each. All need an X server (display.h) and throw OutputError where
// the file cannot be written.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/report/run_folder.h"

namespace platen::apps::report {

// Axial stress against platen, gauge and lateral strain, the peak marked; below,
// broken bonds by mode against platen strain. Several runs share the axes, one colour each.
void draw_stress_strain(const std::vector<Run> &runs, const std::filesystem::path &png);

// The ledger: where the work of the platens went, against platen strain.
void draw_energies(const Run &run, const std::filesystem::path &png);

// Seconds of each stage as bars. The run must have costs (costs.h).
void draw_costs(const Run &run, const std::filesystem::path &png);

// The specimen before the test, at the peak and at the end, coloured by how far each sphere has gone: from
// outside, and cut in half.
void draw_outside(const Run &run, const Extent &extent, const std::filesystem::path &png);
void draw_inside(const Run &run, const Extent &extent, const std::filesystem::path &png);

// The half specimen coloured by outward displacement, or by the broken share of each sphere's bonds: when the
// stress has fallen to 0.8 of the peak (where it did) and at the end. `extent` is the specimen's before the
// test.
void draw_outward_displacement(const Run &run, const Extent &extent, const std::filesystem::path &png);
void draw_damage(const Run &run, const Extent &extent, const std::filesystem::path &png);

// Whether the frames of the run say which piece each sphere is of.
bool tells_fragments(const Run &run);
// Pieces of 30 and more spheres that bonds hold together, in colours, when the stress has fallen to 0.8 of
// the peak and at the end, with the cones that were fitted then. The frames must
// tell fragments.
void draw_fragments(const Run &run, const Extent &extent, const std::filesystem::path &png);
// What to see in it, with the cones in words.
std::string fragments_caption(const Run &run);

// Damage of several runs side by side, each at its Run::pattern_time(). Runs without frames are left out.
void draw_damage_comparison(const std::vector<Run> &runs, const std::filesystem::path &png);
// Outward displacement of several runs at their ends, in one scale: what the platens held is dark.
void draw_displacement_comparison(const std::vector<Run> &runs, const std::filesystem::path &png);

// Pieces and cones of several runs at their ends. Runs without frames, or whose frames do not tell fragments,
// are left out; one must be there.
void draw_fragments_comparison(const std::vector<Run> &runs, const std::filesystem::path &png);

// The bonds broken up to Run::pattern_time() as discs of their areas in the half specimen: those that broke
// in tension on the left, in shear on the right. `before_test` is the first frame of the specimen. The run
// must have cracks.
void draw_cracks(const Run &run, const Spheres &before_test, const std::filesystem::path &png);

// The same coloured by when they broke: before the peak on the left, after it on the right.
void draw_crack_times(const Run &run, const Spheres &before_test, const std::filesystem::path &png);

// The same, counted over radius and height: as a share of the initial bonds where bonds.pvd is there, else
// per volume.
void draw_crack_density(const Run &run, const Spheres &before_test, const std::filesystem::path &png);

// Area of all cracks by the angle of their normals to the axis, over that of cracks that face all ways alike.
// The summary must have it.
bool tells_rose(const Run &run);
void draw_crack_rose(const Run &run, const std::filesystem::path &png);

// How many acoustic events have at least a magnitude, before and after the peak, with the b-values of the
// summary as lines. The run must have events, at least one.
void draw_acoustic(const Run &run, const std::filesystem::path &png);

// Pressure on both platens and shear on the ends of the specimen against the distance from the axis, in the
// frame nearest to the peak. Round specimens; the run must have contacts.
void draw_platen_profiles(const Run &run, const Extent &extent, const std::filesystem::path &png);
// Every sphere at a platen in the same frame, seen along the axis: whether it sticks or slides.
void draw_stick_and_slip(const Run &run, const Extent &extent, const std::filesystem::path &png);

// Vertical stress and largest shear in the plane y = 0, from platen through specimen to platen, in the frame
// nearest to the peak; platens that are rigid in grey. The run must tell stress (field_frame.h).
void draw_stress_flow(const Run &run, const Spheres &before_test, const std::filesystem::path &png);

} // namespace platen::apps::report
