// The search for near balls for the avx512 instruction set; see near_kernel.inc.h.
#define PLATEN_FIND_NEAR find_near_avx512
#include "dem/kernels/near_kernel.inc.h"
