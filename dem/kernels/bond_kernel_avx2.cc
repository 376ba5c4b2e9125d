// Bond kernel for the avx2 instruction set; see bond_kernel.inc.h.
#define PLATEN_LANES 4
#define PLATEN_KERNEL bond_kernel_avx2
#include "dem/kernels/bond_kernel.inc.h"
