// Motion kernels for the avx2 instruction set; see motion_kernel.inc.h.
#define PLATEN_LANES 4
#define PLATEN_KERNEL motion_kernel_avx2
#include "dem/kernels/motion_kernel.inc.h"
