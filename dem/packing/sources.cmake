# Sources of sphere packings, relative to dem/.
set(PLATEN_PACKING_SOURCES
  packing/advancing_front.cc
  packing/direction_cells.cc
  packing/ends.cc
  packing/growth.cc
  packing/quality.cc
  packing/radius_distribution.cc
  packing/soft_spheres.cc
  packing/specimen.cc
  packing/sphere_clipping.cc)
