// Bond kernels for the baseline instruction set; see bond_kernel.inc.h.
#define PLATEN_LANES 2
#define PLATEN_KERNELS bond_kernels_baseline
#include "dem/kernels/bond_kernel.inc.h"
