# Everything that is written. The sources need fmt::fmt, nlohmann_json::nlohmann_json, xxhash, OpenSSL::Crypto and these
# components of VTK: CommonCore CommonDataModel IOXML. Of the project they need dem and apps/scene.
set(PLATEN_OUTPUT_SOURCES
  output/file_lock.cc
  output/file.cc
  output/checkpoint.cc
  output/checkpoint_folder.cc
  output/crack_discs.cc
  output/csv_writer.cc
  output/vtu.cc
  output/pvd.cc
  output/output_folder.cc
  output/sha256.cc
  output/summary.cc
  output/machine.cc
  output/run_log.cc
  output/seed_statistics.cc
  output/progress.cc
  output/state_listing.cc
  output/stop_signal.cc
  output/specimen_csv.cc)
