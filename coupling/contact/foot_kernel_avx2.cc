// Foot kernel for the avx2 instruction set; see foot_kernel.inc.h.
#define PLATEN_LANES 4
#define PLATEN_KERNEL find_feet_avx2
#include "coupling/contact/foot_kernel.inc.h"
