// Kernels of soft spheres for the avx2 instruction set; see soft_kernel.inc.h.
#define PLATEN_LANES 8
#define PLATEN_SOFT_FORCES add_soft_forces_avx2
#define PLATEN_SOFT_DRIFT move_soft_avx2
#include "dem/kernels/soft_kernel.inc.h"
