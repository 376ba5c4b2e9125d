// The specimen as it can be turned on the page of a report: chosen frames, cracks and platens of a run,
// packed into the page together with the program that draws them (viewer/viewer.js, WebGL 2). It needs no
// other file and no network.
#pragma once

#include <string>
#include <vector>

#include "apps/report/run_folder.h"

namespace platen::apps::report {

// What the page holds. `bytes`, little-endian, one after the other: radii (2 bytes each, multiples of meta's
// radius_step); for each frame the places of all spheres (3 x 2 bytes, multiples of `step` from `origin`),
// their damage (1 byte, 255: all bonds broken) and piece (1 byte; 0 the largest, 255 a single sphere); then
// for all cracks places (3 x 2 bytes), normals (3 x 1 byte, 127: 1), modes (1 byte; 0 tension, 1 shear),
// radii of their areas (2 bytes) and the first frame that has them (1 byte); then, with a sleeve, the places
// of the corners of its outer face (3 x 2 bytes) before the test and in each frame.
struct SpecimenView {
  Json meta;
  std::vector<unsigned char> bytes;
};

// Which of `count` frames are shown when at most `most` can be: the first, the last, those of `wanted` and,
// between them, as many as there is room for, evenly. In order; most >= 2 + wanted.size().
std::vector<std::size_t> frames_to_show(std::size_t count, std::size_t most, std::vector<std::size_t> wanted);

// Packs at most `most_frames` frames. The run must have frames of the specimen, whose spheres are the same in
// all of them. Throws InputError where a frame is damaged.
SpecimenView pack_view(const Run &run, const Extent &extent, std::size_t most_frames);

// The whole element for a page: canvas, controls, data, program.
std::string specimen_view_html(const Run &run, const Extent &extent);

} // namespace platen::apps::report
