// Contact kernels for the baseline instruction set; see contact_kernel.inc.h.
#define PLATEN_LANES 2
#define PLATEN_KERNELS contact_kernels_baseline
#include "dem/kernels/contact_kernel.inc.h"
