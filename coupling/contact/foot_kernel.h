// Feet on faces that move or are flat, in packs. One source, compiled once per instruction set
// (foot_kernel.inc.h), to the same last bit.
#pragma once

#include <cstddef>

#include "coupling/contact/faces.h"
#include "dem/instruction_set.h"

namespace platen::coupling::kernels {

// find_foot(*face[k], centre[k], foot[k]) for k < count <= most_feet; found[k]: whether there is one, as it
// says.
constexpr std::size_t most_feet = 32;
using FindFeet = void (*)(const MovingFace *const *face, const Vector3 *centre, std::size_t count, Foot *foot,
                          bool *found);
void find_feet_baseline(const MovingFace *const *, const Vector3 *, std::size_t, Foot *, bool *);
void find_feet_avx2(const MovingFace *const *, const Vector3 *, std::size_t, Foot *, bool *);
void find_feet_avx512(const MovingFace *const *, const Vector3 *, std::size_t, Foot *, bool *);
inline FindFeet find_feet(dem::InstructionSet set) {
  return dem::for_set<FindFeet>(set, find_feet_baseline, find_feet_avx2, find_feet_avx512);
}

// The same of flat faces; centres relative to the first corner of each.
using FindFlatFeet = void (*)(const FlatFace *const *face, const Vector3 *centre, std::size_t count,
                              FlatFoot *foot, bool *found);
void find_flat_feet_baseline(const FlatFace *const *, const Vector3 *, std::size_t, FlatFoot *, bool *);
void find_flat_feet_avx2(const FlatFace *const *, const Vector3 *, std::size_t, FlatFoot *, bool *);
void find_flat_feet_avx512(const FlatFace *const *, const Vector3 *, std::size_t, FlatFoot *, bool *);
inline FindFlatFeet find_flat_feet(dem::InstructionSet set) {
  return dem::for_set<FindFlatFeet>(set, find_flat_feet_baseline, find_flat_feet_avx2, find_flat_feet_avx512);
}

} // namespace platen::coupling::kernels
