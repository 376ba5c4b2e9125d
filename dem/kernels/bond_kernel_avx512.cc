// Bond kernels for the avx512 instruction set; see bond_kernel.inc.h.
#define PLATEN_LANES 8
#define PLATEN_KERNELS bond_kernels_avx512
#include "dem/kernels/bond_kernel.inc.h"
