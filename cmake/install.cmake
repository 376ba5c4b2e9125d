# cmake --install puts programs into bin, libraries into lib, headers into include/platen, what find_package(Platen)
# reads into lib/cmake/Platen, and into share/platen scenes, examples, documentation with the measurements that it cites,
# and the scripts that go with them, at the same places as in the sources: what one names by its path is there. Man pages
# go into share/man. Each rule belongs to a component, of which packages are made (package.cmake): programs, development,
# documentation, python.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(platen_installed base dem)
if(PLATEN_RANKS)
  list(APPEND platen_installed dist)
endif()
if(PLATEN_APPS)
  list(APPEND platen_installed fem solids coupling)
endif()
install(TARGETS platen_options EXPORT PlatenTargets)
install(DIRECTORY base DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/platen COMPONENT development
  FILES_MATCHING PATTERN "*.h")
foreach(name IN LISTS platen_installed)
  # Shared libraries, where BUILD_SHARED_LIBS asks for them, change with each minor version as long as the first is 0.
  set_target_properties(platen_${name} PROPERTIES EXPORT_NAME ${name}
    VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
  install(TARGETS platen_${name} EXPORT PlatenTargets
    ARCHIVE COMPONENT development LIBRARY COMPONENT development NAMELINK_COMPONENT development)
  if(IS_DIRECTORY ${PROJECT_SOURCE_DIR}/${name}) # solids are in fem
    install(DIRECTORY ${name} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/platen COMPONENT development
      FILES_MATCHING PATTERN "*.h")
  endif()
endforeach()
set(platen_cmake ${CMAKE_INSTALL_LIBDIR}/cmake/Platen)
install(EXPORT PlatenTargets NAMESPACE Platen:: DESTINATION ${platen_cmake} COMPONENT development)
configure_package_config_file(cmake/PlatenConfig.cmake.in ${CMAKE_BINARY_DIR}/PlatenConfig.cmake
  INSTALL_DESTINATION ${platen_cmake})
write_basic_package_version_file(${CMAKE_BINARY_DIR}/PlatenConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/PlatenConfig.cmake ${CMAKE_BINARY_DIR}/PlatenConfigVersion.cmake
  cmake/PlatenBondLaw.cmake cmake/kernels.cmake
  DESTINATION ${platen_cmake} COMPONENT development)

set(platen_share ${CMAKE_INSTALL_DATADIR}/platen)
install(DIRECTORY examples DESTINATION ${platen_share} COMPONENT development)
install(DIRECTORY docs DESTINATION ${platen_share} COMPONENT documentation
  PATTERN manual EXCLUDE PATTERN sketches EXCLUDE)
install(DIRECTORY bench/results DESTINATION ${platen_share}/bench COMPONENT documentation)
install(FILES README.md LICENSE DESTINATION ${platen_share} COMPONENT documentation)
if(PLATEN_APPS)
  install(DIRECTORY scenes DESTINATION ${platen_share} COMPONENT programs)
  install(PROGRAMS scripts/slurm/study_array.sh DESTINATION ${platen_share}/scripts/slurm COMPONENT programs)
  install(PROGRAMS scripts/demo.sh DESTINATION ${platen_share}/scripts COMPONENT programs)
  install(FILES scripts/brush_platen.py DESTINATION ${platen_share}/scripts COMPONENT programs)
  # One file for all programs; the shell looks for it by the name of each.
  set(completions ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
  install(FILES scripts/completion/platen DESTINATION ${completions} COMPONENT programs)
  foreach(program IN ITEMS pack bonds bar compress brazilian calibrate study report)
    file(MAKE_DIRECTORY ${CMAKE_BINARY_DIR}/completions)
    file(CREATE_LINK platen ${CMAKE_BINARY_DIR}/completions/platen-${program} SYMBOLIC)
    install(FILES ${CMAKE_BINARY_DIR}/completions/platen-${program} DESTINATION ${completions} COMPONENT programs)
  endforeach()
endif()

# Man pages are what the programs say of themselves when they are installed.
find_package(Python3 COMPONENTS Interpreter QUIET)
if(PLATEN_APPS AND Python3_FOUND)
  install(CODE "execute_process(COMMAND \"${Python3_EXECUTABLE}\" -B \"${PROJECT_SOURCE_DIR}/scripts/man_pages.py\"
    \"${CMAKE_BINARY_DIR}\" \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_MANDIR}\" COMMAND_ERROR_IS_FATAL ANY)" COMPONENT programs)
endif()
