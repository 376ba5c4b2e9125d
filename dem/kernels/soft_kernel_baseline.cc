// Kernels of soft spheres for the baseline instruction set; see soft_kernel.inc.h.
#define PLATEN_LANES 4
#define PLATEN_SOFT_FORCES add_soft_forces_baseline
#define PLATEN_SOFT_DRIFT move_soft_baseline
#include "dem/kernels/soft_kernel.inc.h"
