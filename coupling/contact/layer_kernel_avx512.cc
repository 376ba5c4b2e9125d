// Layer kernel for the avx512 instruction set; see layer_kernel.inc.h.
#define PLATEN_LANES 8
#define PLATEN_KERNEL compute_rows_avx512
#include "coupling/contact/layer_kernel.inc.h"
