# Sources of platen-bonds but for its main, apps/platen_bonds.cc; linked with platen_run.
set(PLATEN_BONDS_SOURCES
  bonds/bond_rig.cc
  bonds/closed_forms.cc
  bonds/interface_forms.cc
  bonds/interface_path.cc
  bonds/interface_results.cc
  bonds/interface_rig.cc
  bonds/load_path.cc
  bonds/run_bonds.cc)
