// The search for near balls for the avx2 instruction set; see near_kernel.inc.h.
#define PLATEN_FIND_NEAR find_near_avx2
#include "dem/kernels/near_kernel.inc.h"
