// Push kernel for the avx2 instruction set; see push_kernel.inc.h.
#define PLATEN_LANES 4
#define PLATEN_KERNEL push_rows_avx2
#include "coupling/contact/push_kernel.inc.h"
