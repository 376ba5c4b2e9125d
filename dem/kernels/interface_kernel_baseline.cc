// Interface kernel for the baseline instruction set; see interface_kernel.inc.h.
#define PLATEN_LANES 2
#define PLATEN_KERNELS interface_kernel_baseline
#include "dem/kernels/interface_kernel.inc.h"
