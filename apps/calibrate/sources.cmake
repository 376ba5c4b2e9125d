# Sources of platen-calibrate but for its main, apps/platen_calibrate.cc; linked with platen_run.
set(PLATEN_CALIBRATE_SOURCES
  calibrate/abacus.cc
  calibrate/response_model.cc
  calibrate/run_calibrate.cc
  calibrate/search.cc
  calibrate/strengths.cc
  calibrate/trial.cc
  calibrate/trials.cc)
