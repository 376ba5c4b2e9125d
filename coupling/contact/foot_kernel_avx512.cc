// Foot kernels for the avx512 instruction set; see foot_kernel.inc.h.
#define PLATEN_LANES 8
#define PLATEN_FEET find_feet_avx512
#define PLATEN_FLAT_FEET find_flat_feet_avx512
#define PLATEN_SET_FACES set_faces_avx512
#include "coupling/contact/foot_kernel.inc.h"
