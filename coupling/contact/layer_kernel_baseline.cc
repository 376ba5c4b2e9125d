// Layer kernel for the baseline instruction set; see layer_kernel.inc.h.
#define PLATEN_LANES 2
#define PLATEN_KERNEL compute_rows_baseline
#include "coupling/contact/layer_kernel.inc.h"
