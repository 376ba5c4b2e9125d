// Motion kernels for the baseline instruction set; see motion_kernel.inc.h.
#define PLATEN_LANES 2
#define PLATEN_KERNEL motion_kernel_baseline
#include "dem/kernels/motion_kernel.inc.h"
