// Motion kernels for the avx512 instruction set; see motion_kernel.inc.h.
#define PLATEN_LANES 8
#define PLATEN_KERNEL motion_kernel_avx512
#include "dem/kernels/motion_kernel.inc.h"
