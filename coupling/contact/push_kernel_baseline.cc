// Push kernel for the baseline instruction set; see push_kernel.inc.h.
#define PLATEN_LANES 2
#define PLATEN_KERNEL push_rows_baseline
#include "coupling/contact/push_kernel.inc.h"
