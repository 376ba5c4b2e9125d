# Everything that is written. The sources need fmt::fmt, nlohmann_json::nlohmann_json, xxhash and these components of
# VTK: CommonCore CommonDataModel IOXML IOXMLParser. Of the project they need dem and the header apps/scene/errors.h.
set(PLATEN_IO_SOURCES
  io/byte_lock.cc
  io/file.cc
  io/checkpoint.cc
  io/checkpoint_folder.cc
  io/crack_discs.cc
  io/csv_writer.cc
  io/vtu.cc
  io/write_queue.cc
  io/pvd.cc
  io/pvtu.cc
  io/vtk_xml.cc
  io/output_folder.cc
  io/sha256.cc
  io/summary.cc
  io/machine.cc
  io/run_log.cc
  io/seed_statistics.cc
  io/progress.cc
  io/stop_signal.cc
  io/specimen_csv.cc)
