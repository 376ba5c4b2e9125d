// platen-study: sweeps what a result may depend on, each case on several seeds.
#include "apps/study/cases.h"
#include "apps/study/run_study.h"

int main(int argc, char **argv) {
  using namespace platen::apps;
  AppDescription app{
      AppKind::study, "platen-study",
      "Runs platen-compress over platens, slendernesses, sizes, packings, rates or what trades accuracy for "
      "time, each on several seeds, and tables the results.",
      study_kinds()};
  app.plans_runs = true;
  return run_app(argc, argv, app, run_study);
}
