# Sources of platen-study; linked with platen_run.
set(PLATEN_STUDY_SOURCES
  study/accuracy.cc
  study/accuracy_cases.cc
  study/cases.cc
  study/comparisons.cc
  study/failure_envelope.cc
  study/plan_file.cc
  study/planned_runs.cc
  study/platen_cases.cc
  study/run_study.cc
  study/study_results.cc
  study/study_setup.cc
  study/tables.cc
  study/target_cases.cc
  study/target_figures.cc
  study/target_report.cc
  study/target_study.cc)

# What runs tell of a figure and which runs are the cheapest: statistics alone.
set(PLATEN_TARGET_STATISTICS_SOURCES
  study/target_model.cc
  study/target_plan.cc)
