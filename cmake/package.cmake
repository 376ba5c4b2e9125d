# Debian packages, made by cpack (scripts/package.sh): platen, libplaten-dev, platen-doc, python3-platen. They are made of the
# components of install.cmake; what each needs of shared libraries dpkg-shlibdeps finds.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME platen)
set(CPACK_PACKAGE_VENDOR "Platen")
# Who makes them, as Debian's tools ask; else the address by which Debian would reach the maintainer of a package of this name.
if(DEFINED ENV{DEBFULLNAME} AND DEFINED ENV{DEBEMAIL})
  set(CPACK_PACKAGE_CONTACT "$ENV{DEBFULLNAME} <$ENV{DEBEMAIL}>")
else()
  set(CPACK_PACKAGE_CONTACT "Platen developers <platen@packages.debian.org>")
endif()
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_COMPONENTS_ALL programs development documentation python)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
  OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)

set(platen_packages programs=platen development=libplaten-dev documentation=platen-doc python=python3-platen)
find_program(platen_gzip gzip)
foreach(pair IN LISTS platen_packages)
  string(REGEX REPLACE "=.*" "" component ${pair})
  string(REGEX REPLACE ".*=" "" package ${pair})
  string(TOUPPER ${component} upper)
  set(CPACK_DEBIAN_${upper}_PACKAGE_NAME ${package})
  set(CPACK_DEBIAN_${upper}_FILE_NAME DEB-DEFAULT)
  set(CPACK_DEBIAN_${upper}_PACKAGE_SHLIBDEPS OFF)
  # Policy: a copyright and a changelog in each.
  set(own ${CMAKE_BINARY_DIR}/debian/${package})
  file(MAKE_DIRECTORY ${own})
  configure_file(debian/copyright ${own}/copyright COPYONLY)
  configure_file(debian/changelog ${own}/changelog.Debian COPYONLY)
  if(platen_gzip)
    execute_process(COMMAND ${platen_gzip} -9nf ${own}/changelog.Debian)
  endif()
  install(FILES ${own}/copyright ${own}/changelog.Debian.gz DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${package}
    COMPONENT ${component} EXCLUDE_FROM_ALL)
endforeach()

# Policy too: man pages are packed small. The manual is in platen-doc where scripts/manual.sh has made it.
install(CODE "file(GLOB pages \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_MANDIR}/man1/*.1\")
  if(pages)
    execute_process(COMMAND gzip -9nf \${pages} COMMAND_ERROR_IS_FATAL ANY)
  endif()" COMPONENT programs EXCLUDE_FROM_ALL)
install(DIRECTORY ${CMAKE_BINARY_DIR}/manual/ DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/platen-doc/html
  COMPONENT documentation EXCLUDE_FROM_ALL OPTIONAL PATTERN man EXCLUDE)

set(CPACK_DEBIAN_PROGRAMS_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PROGRAMS_PACKAGE_DEPENDS "python3, python3-matplotlib")
set(CPACK_DEBIAN_PROGRAMS_PACKAGE_CONTROL_EXTRA ${PROJECT_SOURCE_DIR}/debian/platen/postinst ${PROJECT_SOURCE_DIR}/debian/platen/prerm)
set(CPACK_DEBIAN_PROGRAMS_PACKAGE_RECOMMENDS "bash-completion")
set(CPACK_DEBIAN_PROGRAMS_PACKAGE_SUGGESTS "platen-doc, python3-platen, paraview, openmpi-bin, fonts-wqy-microhei")
set(CPACK_COMPONENT_PROGRAMS_DESCRIPTION "laboratory of bonded spheres between finite-element platens
Platen crushes, confines, bends, splits and pulls specimens of bonded discrete
elements (concrete, rock, glass) between the platens of a testing machine,
which are finite elements, rigid or elastic, coupled by contact with friction.
It answers how much of a measured strength is the doing of the platens. Every
run closes its energy balance and repeats to the byte.
.
This package has the programs, their man pages and the scenes.")

set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
  "libdeal.ii-dev, libeigen3-dev, voro++-dev, libopenmpi-dev, libtrilinos-zoltan-dev, libxxhash-dev")
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "bonded spheres between finite-element platens, library
Platen crushes specimens of bonded discrete elements between the platens of a
testing machine, which are finite elements.
.
This package has headers, static libraries, the configuration for CMake's
find_package(Platen) and examples.")

set(CPACK_DEBIAN_DOCUMENTATION_PACKAGE_ARCHITECTURE all)
set(CPACK_DEBIAN_DOCUMENTATION_PACKAGE_SECTION doc)
set(CPACK_COMPONENT_DOCUMENTATION_DESCRIPTION "bonded spheres between finite-element platens, manual
Platen crushes specimens of bonded discrete elements between the platens of a
testing machine, which are finite elements.
.
This package has the manual, the theory and the measurements behind it.")

set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "python3 (>= 3.11~), python3 (<< 3.12), python3-numpy")
set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA
  ${PROJECT_SOURCE_DIR}/debian/python3-platen/postinst ${PROJECT_SOURCE_DIR}/debian/python3-platen/prerm)
set(CPACK_DEBIAN_PYTHON_PACKAGE_RECOMMENDS "platen, python3-matplotlib")
set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS "python3-pandas")
set(CPACK_COMPONENT_PYTHON_DESCRIPTION "bonded spheres between finite-element platens, Python
Platen crushes specimens of bonded discrete elements between the platens of a
testing machine, which are finite elements.
.
This package reads its results as numpy arrays, draws them, and builds, runs
and changes experiments in a script.")
include(CPack)
