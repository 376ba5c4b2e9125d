// Kernels of soft spheres for the avx512 instruction set; see soft_kernel.inc.h.
#define PLATEN_LANES 16
#define PLATEN_SOFT_FORCES add_soft_forces_avx512
#define PLATEN_SOFT_DRIFT move_soft_avx512
#include "dem/kernels/soft_kernel.inc.h"
