# cmake --install puts programs into bin, libraries into lib, headers into include/platen, and what find_package(Platen)
# reads into lib/cmake/Platen.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(platen_installed base dem)
if(PLATEN_APPS)
  list(APPEND platen_installed fem coupling)
endif()
install(TARGETS platen_options EXPORT PlatenTargets)
install(DIRECTORY base DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/platen FILES_MATCHING PATTERN "*.h")
foreach(name IN LISTS platen_installed)
  set_target_properties(platen_${name} PROPERTIES EXPORT_NAME ${name})
  install(TARGETS platen_${name} EXPORT PlatenTargets)
  install(DIRECTORY ${name} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/platen FILES_MATCHING PATTERN "*.h"
    PATTERN "kernels" EXCLUDE)
endforeach()
set(platen_cmake ${CMAKE_INSTALL_LIBDIR}/cmake/Platen)
install(EXPORT PlatenTargets NAMESPACE Platen:: DESTINATION ${platen_cmake})
configure_package_config_file(cmake/PlatenConfig.cmake.in ${CMAKE_BINARY_DIR}/PlatenConfig.cmake
  INSTALL_DESTINATION ${platen_cmake})
write_basic_package_version_file(${CMAKE_BINARY_DIR}/PlatenConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/PlatenConfig.cmake ${CMAKE_BINARY_DIR}/PlatenConfigVersion.cmake
  DESTINATION ${platen_cmake})
