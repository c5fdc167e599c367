# Debian packages by CPack, split as Debian splits them; preset `debian`, `cpack --config build/debian/CPackConfig.cmake`:
#
#   temper           the program, manual pages, completions
#   libtemper0.1     the shared libraries, called by the version of their interface
#   libtemper-dev    headers, CMake's and pkg-config's files
#   python3-temper   the Python module
set(here ${CMAKE_CURRENT_LIST_DIR})
set(libraries_package libtemper${TEMPER_SOVERSION})

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME temper)
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")  # each package has its own
set(CPACK_PACKAGE_VENDOR "The temper authors")
set(CPACK_PACKAGE_CONTACT "The temper authors <packages@temper.invalid>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL program libraries development python)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
# Packages for Debian 12 and for Ubuntu 24.04 differ: 1+debian12, 1+ubuntu24.04.
cmake_host_system_information(RESULT system QUERY DISTRIB_ID DISTRIB_VERSION_ID)
list(JOIN system "" system)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1+${system})
string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC)  # of the commit, by SOURCE_DATE_EPOCH
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
foreach(library temper temper_tets temper_surfaces temper_io temper_lp temper_tbb temper_errors temper_solvers)
  if(TARGET ${library})  # where dpkg-shlibdeps finds the libraries of another package of these
    get_target_property(folder ${library} BINARY_DIR)
    list(APPEND CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${folder})
  endif()
endforeach()

# The HTML report has libraries of others in it.
file(READ ${PROJECT_SOURCE_DIR}/web/report/dist/NOTICE notice)
string(STRIP "${notice}" notice)
string(REPLACE "\n" "\n " notice " ${notice}")
string(REGEX REPLACE "\n +(\n|$)" "\n .\n" notice "${notice}")
string(REGEX REPLACE "\n +(\n|$)" "\n .\n" notice "${notice}")
configure_file(${here}/copyright.in ${PROJECT_BINARY_DIR}/debian/copyright @ONLY)

# debian_package(COMPONENT PACKAGE SECTION SUMMARY TEXT)
function(debian_package component package section summary text)
  string(TOUPPER ${component} key)
  set(CPACK_DEBIAN_${key}_PACKAGE_NAME ${package} PARENT_SCOPE)
  set(CPACK_DEBIAN_${key}_PACKAGE_SECTION ${section} PARENT_SCOPE)
  set(CPACK_DEBIAN_${key}_DESCRIPTION "${summary}\n${text}" PARENT_SCOPE)

  set(doc ${CMAKE_INSTALL_DATADIR}/doc/${package})
  install(FILES ${PROJECT_BINARY_DIR}/debian/copyright DESTINATION ${doc} COMPONENT ${component})
  configure_file(${here}/changelog.in ${PROJECT_BINARY_DIR}/debian/${package}/changelog @ONLY)
  execute_process(COMMAND gzip -9nf ${PROJECT_BINARY_DIR}/debian/${package}/changelog COMMAND_ERROR_IS_FATAL ANY)
  install(FILES ${PROJECT_BINARY_DIR}/debian/${package}/changelog.gz DESTINATION ${doc} RENAME changelog.Debian.gz
          COMPONENT ${component})
endfunction()

set(about "temper improves meshes of triangles and tetrahedra for solvers that use the\ndual mesh: it makes coefficients positive, lowers errors and keeps the\nboundary.\n")
debian_package(program temper science "primal-dual triangle and tetrahedral meshes that solvers can trust"
               "${about}.\nThis package has the program.")
debian_package(libraries ${libraries_package} libs "primal-dual meshes: shared libraries"
               "${about}.\nThis package has the shared libraries.")
debian_package(development libtemper-dev libdevel "primal-dual meshes: headers"
               "${about}.\nThis package has what programs in C++ are compiled with.")
debian_package(python python3-temper python "primal-dual meshes: Python module"
               "${about}.\nThis package has the module for Python 3.")

set(Python_EXECUTABLE ${TEMPER_PYTHON})
find_package(Python REQUIRED COMPONENTS Interpreter)
set(version "(= ${PROJECT_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE})")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_DEPENDS "${libraries_package} ${version}")
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
    "${libraries_package} ${version}, python3-numpy, python3 (>= ${Python_VERSION_MAJOR}.${Python_VERSION_MINOR})")
math(EXPR next_minor "${Python_VERSION_MINOR} + 1")
string(APPEND CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS ", python3 (<< ${Python_VERSION_MAJOR}.${next_minor})")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "${libraries_package} ${version}")
# What is loaded when a file needs it: not to be found among what is linked.
set(CPACK_DEBIAN_LIBRARIES_PACKAGE_SUGGESTS "libnetcdf19 | libnetcdf19t64, libhdf5-103-1 | libhdf5-103-1t64")
set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS "temper, python3-scipy, python3-matplotlib, python3-meshio")
set(CPACK_DEBIAN_LIBRARIES_PACKAGE_CONTROL_EXTRA "${here}/libtemper/triggers")
set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA "${here}/python3-temper/postinst;${here}/python3-temper/prerm")

# CPack strips programs and shared libraries, but takes no Python module for one.
set_property(TARGET temper_python APPEND_STRING PROPERTY LINK_FLAGS " -s")
include(CPack)
