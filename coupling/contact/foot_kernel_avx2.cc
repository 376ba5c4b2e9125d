// Foot kernels for the avx2 instruction set; see foot_kernel.inc.h.
#define PLATEN_LANES 4
#define PLATEN_FEET find_feet_avx2
#define PLATEN_FLAT_FEET find_flat_feet_avx2
#define PLATEN_SET_FACES set_faces_avx2
#include "coupling/contact/foot_kernel.inc.h"
