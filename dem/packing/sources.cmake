# Sources of sphere packings, relative to dem/.
set(PLATEN_PACKING_SOURCES
  packing/advancing_front.cc
  packing/ends.cc
  packing/growth.cc
  packing/radius_distribution.cc
  packing/soft_spheres.cc
  packing/specimen.cc)
