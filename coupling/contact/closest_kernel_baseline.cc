// Closest point kernels for the baseline instruction set; see closest_kernel.inc.h.
#define PLATEN_LANES 2
#define PLATEN_CLOSEST_POINTS find_closest_points_baseline
#define PLATEN_FLAT_CLOSEST_POINTS find_flat_closest_points_baseline
#define PLATEN_SET_FACES set_faces_baseline
#include "coupling/contact/closest_kernel.inc.h"
