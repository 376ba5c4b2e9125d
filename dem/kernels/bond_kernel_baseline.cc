// Bond kernel for the baseline instruction set; see bond_kernel.inc.h.
#define PLATEN_LANES 4
#define PLATEN_KERNEL bond_kernel_baseline
#include "dem/kernels/bond_kernel.inc.h"
