// Foot kernels for the baseline instruction set; see foot_kernel.inc.h.
#define PLATEN_LANES 2
#define PLATEN_FEET find_feet_baseline
#define PLATEN_FLAT_FEET find_flat_feet_baseline
#define PLATEN_SET_FACES set_faces_baseline
#include "coupling/contact/foot_kernel.inc.h"
