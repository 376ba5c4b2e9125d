# Sources of platen-bonds; linked with platen_run.
set(PLATEN_BONDS_SOURCES
  bonds/bond_results.cc
  bonds/bond_rig.cc
  bonds/closed_forms.cc
  bonds/cohesive_forms.cc
  bonds/guided_pair.cc
  bonds/load_path.cc
  bonds/moment_forms.cc
  bonds/run_bonds.cc)
