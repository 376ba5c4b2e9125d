# The list of programs, with the sections that single programs read.
set(PLATEN_PROGRAM_SOURCES
  programs.cc
  bar/bar_section.cc
  bonds/pair_section.cc
  calibrate/calibrate_section.cc
  calibrate/choice.cc
  calibrate/target.cc
  study/study_section.cc)
