# Sources of platen-bonds; linked with platen_run.
set(PLATEN_BONDS_SOURCES
  bonds/bond_rig.cc
  bonds/bond_run.cc
  bonds/load_path.cc
  bonds/prescribed_pair.cc
  bonds/run_bonds.cc)
