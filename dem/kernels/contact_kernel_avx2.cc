// Contact kernel for the avx2 instruction set; see contact_kernel.inc.h.
#define PLATEN_LANES 4
#define PLATEN_KERNEL rows_at_work_avx2
#include "dem/kernels/contact_kernel.inc.h"
