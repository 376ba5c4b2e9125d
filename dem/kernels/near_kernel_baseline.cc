// The search for near balls for the baseline instruction set; see near_kernel.inc.h.
#define PLATEN_FIND_NEAR find_near_baseline
#include "dem/kernels/near_kernel.inc.h"
