# Sources of platen-report but for its main, apps/platen_report.cc, which also needs CLI11 and version_text()
# (scene/version.cc). The sources need platen_io, nlohmann_json::nlohmann_json, X11::X11
# (find_package(X11)) and these components of VTK:
#   ChartsCore CommonColor CommonCore CommonDataModel FiltersCore FiltersGeneral FiltersSources IOCore IOImage IOXML IOXMLParser
#   RenderingAnnotation RenderingContext2D RenderingContextOpenGL2 RenderingCore RenderingFreeType RenderingOpenGL2
# and vtk_module_autoinit() with them, else nothing is drawn.
set(PLATEN_REPORT_SOURCES
  report/accuracy_report.cc
  report/accuracy_results.cc
  report/acoustic.cc
  report/bars.cc
  report/canvas.cc
  report/chart.cc
  report/comparison.cc
  report/cones.cc
  report/cost_picture.cc
  report/costs.cc
  report/crack_density.cc
  report/crack_pictures.cc
  report/crack_rose_picture.cc
  report/csv.cc
  report/curves.cc
  report/display.cc
  report/field_files.cc
  report/field_frame.cc
  report/fragment_pictures.cc
  report/frames.cc
  report/heat_map.cc
  report/html_page.cc
  report/moments.cc
  report/platen_contacts.cc
  report/platen_pictures.cc
  report/report.cc
  report/run_folder.cc
  report/specimen_pictures.cc
  report/specimen_view.cc
  report/stress_pictures.cc
  report/study_curves.cc
  report/study_report.cc
  report/study_results.cc
  report/state_listing.cc
  report/style.cc)
