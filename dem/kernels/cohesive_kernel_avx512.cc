// Cohesive kernel for the avx512 instruction set; see cohesive_kernel.inc.h.
#define PLATEN_LANES 8
#define PLATEN_KERNELS cohesive_kernel_avx512
#include "dem/kernels/cohesive_kernel.inc.h"
