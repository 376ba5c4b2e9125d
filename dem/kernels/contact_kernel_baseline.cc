// Contact kernel for the baseline instruction set; see contact_kernel.inc.h.
#define PLATEN_LANES 2
#define PLATEN_KERNEL rows_at_work_baseline
#include "dem/kernels/contact_kernel.inc.h"
