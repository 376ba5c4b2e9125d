// Contact kernels for the avx2 instruction set; see contact_kernel.inc.h.
#define PLATEN_LANES 4
#define PLATEN_KERNELS contact_kernels_avx2
#include "dem/kernels/contact_kernel.inc.h"
