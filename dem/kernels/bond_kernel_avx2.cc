// Bond kernels for the avx2 instruction set; see bond_kernel.inc.h.
#define PLATEN_LANES 4
#define PLATEN_KERNELS bond_kernels_avx2
#include "dem/kernels/bond_kernel.inc.h"
