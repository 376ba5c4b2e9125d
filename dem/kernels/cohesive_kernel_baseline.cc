// Cohesive kernel for the baseline instruction set; see cohesive_kernel.inc.h.
#define PLATEN_LANES 2
#define PLATEN_KERNELS cohesive_kernel_baseline
#include "dem/kernels/cohesive_kernel.inc.h"
