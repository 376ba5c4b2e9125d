# Sources of platen-report but for its main, apps/platen_report.cc, which also needs CLI11 and version_text()
# (scene/version.cc). The sources need platen_output, nlohmann_json::nlohmann_json, X11::X11
# (find_package(X11)) and these components of VTK:
#   ChartsCore CommonColor CommonCore CommonDataModel FiltersCore FiltersGeneral FiltersSources IOCore IOImage IOXML IOXMLParser
#   RenderingAnnotation RenderingContext2D RenderingContextOpenGL2 RenderingCore RenderingFreeType RenderingOpenGL2
# fontconfig (find_package(Fontconfig))
# and vtk_module_autoinit() with them, else nothing is drawn.
set(PLATEN_REPORT_SOURCES
  report/accuracy_study.cc
  report/bar_report.cc
  report/bars.cc
  report/base64.cc
  report/biaxial.cc
  report/bond_report.cc
  report/calibration.cc
  report/canvas.cc
  report/chart.cc
  report/chart_points.cc
  report/chart_svg.cc
  report/cones.cc
  report/crack_pictures.cc
  report/confinement.cc
  report/cracks.cc
  report/csv.cc
  report/curves.cc
  report/display.cc
  report/embedded.cc
  report/envelope.cc
  report/fields.cc
  report/frames.cc
  report/friction.cc
  report/head.cc
  report/joined.cc
  report/letters.cc
  report/other_results.cc
  report/packing_report.cc
  report/page.cc
  report/parameter_study.cc
  report/platen_study.cc
  report/platens.cc
  report/report.cc
  report/run_folder.cc
  report/sides.cc
  report/sleeve.cc
  report/sleeve_pictures.cc
  report/specimen_pictures.cc
  report/specimen_view.cc
  report/stages.cc
  report/stress_flow.cc
  report/strips.cc
  report/study_curves.cc
  report/target_study.cc
  report/viewer.cc)
