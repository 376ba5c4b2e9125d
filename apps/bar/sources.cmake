# Sources of platen-bar; linked with platen_run.
set(PLATEN_BAR_SOURCES
  bar/bar.cc
  bar/bar_results.cc
  bar/dynamic_test.cc
  bar/run_bar.cc
  bar/static_test.cc
  bar/strength_of_materials.cc)
