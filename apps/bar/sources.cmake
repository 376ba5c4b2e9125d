# Sources of platen-bar; linked with platen_run.
set(PLATEN_BAR_SOURCES
  bar/bar.cc
  bar/bar_results.cc
  bar/bar_oscillations.cc
  bar/run_bar.cc
  bar/bar_at_rest.cc
  bar/strength_of_materials.cc)
