// Cohesive kernel for the avx2 instruction set; see cohesive_kernel.inc.h.
#define PLATEN_LANES 4
#define PLATEN_KERNELS cohesive_kernel_avx2
#include "dem/kernels/cohesive_kernel.inc.h"
