// The sources of the avx512 kernels compiled for whatever the tests are compiled for, so that their eight
// lanes are tried on any processor.
#define PLATEN_LANES 8
#define PLATEN_KERNELS bond_kernels_of_eight_lanes
#define PLATEN_KERNEL motion_kernel_of_eight_lanes
#include "dem/kernels/bond_kernel.h"
#include "dem/kernels/motion_kernel.h"

namespace platen::dem::kernels {
extern const BondKernels bond_kernels_of_eight_lanes;
MotionKernel motion_kernel_of_eight_lanes(Halves, const MotionEffects &);
} // namespace platen::dem::kernels

#include "dem/kernels/bond_kernel.inc.h"
#include "dem/kernels/motion_kernel.inc.h"
