// Foot kernel for the avx512 instruction set; see foot_kernel.inc.h.
#define PLATEN_LANES 8
#define PLATEN_KERNEL find_feet_avx512
#include "coupling/contact/foot_kernel.inc.h"
