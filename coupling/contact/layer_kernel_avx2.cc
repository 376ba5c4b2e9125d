// Layer kernel for the avx2 instruction set; see layer_kernel.inc.h.
#define PLATEN_LANES 4
#define PLATEN_KERNEL compute_rows_avx2
#include "coupling/contact/layer_kernel.inc.h"
