// Contact kernels for the avx512 instruction set; see contact_kernel.inc.h.
#define PLATEN_LANES 8
#define PLATEN_KERNELS contact_kernels_avx512
#include "dem/kernels/contact_kernel.inc.h"
