// Closest point kernels for the avx512 instruction set; see closest_kernel.inc.h.
#define PLATEN_LANES 8
#define PLATEN_CLOSEST_POINTS find_closest_points_avx512
#define PLATEN_FLAT_CLOSEST_POINTS find_flat_closest_points_avx512
#define PLATEN_SET_FACES set_faces_avx512
#include "coupling/contact/closest_kernel.inc.h"
