// Interface kernel for the avx512 instruction set; see interface_kernel.inc.h.
#define PLATEN_LANES 8
#define PLATEN_KERNELS interface_kernel_avx512
#include "dem/kernels/interface_kernel.inc.h"
