// Interface kernel for the avx2 instruction set; see interface_kernel.inc.h.
#define PLATEN_LANES 4
#define PLATEN_KERNELS interface_kernel_avx2
#include "dem/kernels/interface_kernel.inc.h"
