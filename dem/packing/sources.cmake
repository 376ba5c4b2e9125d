# Sources of sphere packings, relative to dem/.
set(PLATEN_PACKING_SOURCES
  packing/growth.cc
  packing/soft_spheres.cc
  packing/specimen.cc)
