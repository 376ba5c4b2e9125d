// Foot kernel for the baseline instruction set; see foot_kernel.inc.h.
#define PLATEN_LANES 2
#define PLATEN_KERNEL find_feet_baseline
#include "coupling/contact/foot_kernel.inc.h"
