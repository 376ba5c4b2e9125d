// Push kernel for the avx512 instruction set; see push_kernel.inc.h.
#define PLATEN_LANES 8
#define PLATEN_KERNEL push_rows_avx512
#include "coupling/contact/push_kernel.inc.h"
