// Bond kernels for the baseline instruction set; see bond_kernel.inc.h.
#define PLATEN_LANES 4
#define PLATEN_KERNELS bond_kernels_baseline
#include "dem/kernels/bond_kernel.inc.h"
