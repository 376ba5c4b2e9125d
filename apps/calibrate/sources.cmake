# Sources of platen-calibrate; linked with platen_run.
set(PLATEN_CALIBRATE_SOURCES
  calibrate/abacus.cc
  calibrate/analysis.cc
  calibrate/curve.cc
  calibrate/expected_tests.cc
  calibrate/found_report.cc
  calibrate/goals.cc
  calibrate/response_model.cc
  calibrate/run_calibrate.cc
  calibrate/search.cc
  calibrate/space.cc
  calibrate/trials.cc)
