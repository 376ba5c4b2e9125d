// Closest point kernels for the avx2 instruction set; see closest_kernel.inc.h.
#define PLATEN_LANES 4
#define PLATEN_CLOSEST_POINTS find_closest_points_avx2
#define PLATEN_FLAT_CLOSEST_POINTS find_flat_closest_points_avx2
#define PLATEN_SET_FACES set_faces_avx2
#include "coupling/contact/closest_kernel.inc.h"
