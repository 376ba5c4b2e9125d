# parameter_writer.cc is the only file with heavy deal.II headers.
set(PLATEN_SCENE_SOURCES
  scene/units.cc
  scene/values.cc
  scene/parameters.cc
  scene/declare.cc
  scene/sections.cc
  scene/file_text.cc
  scene/prm_file.cc
  scene/json_file.cc
  scene/parameter_writer.cc
  scene/checks.cc
  scene/scene.cc
  scene/expect.cc
  scene/command_line.cc
  scene/run_app.cc
  scene/version.cc)
