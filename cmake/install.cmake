# Installs the libraries, and what find_package(temper COMPONENTS core tets surfaces io lp tbb mpi errors solvers) and pkg-config
# need. The flags of temper's own code (temper_flags) stay here: they are linked for the build alone and are in no export.
#
# Components: `program` (apps/temper), `libraries` (shared ones, for programs to run), `development`, `python`.
include(CMakePackageConfigHelpers)

set(TEMPER_CMAKE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/temper)
set(TEMPER_PKGCONFIG_DIR ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
file(RELATIVE_PATH TEMPER_PREFIX_OF_PKGCONFIG ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig ${CMAKE_INSTALL_PREFIX})

# One library: temper_install(TARGET NAME DESCRIPTION [REQUIRES …: its pkg-config packages] [LIBS …: its other
# libraries]). What only it needs is for whoever links it as a static library: pkg-config --static.
function(temper_install target name description)
  cmake_parse_arguments(ARG "" "" "REQUIRES;LIBS" ${ARGN})
  string(SUBSTRING ${name} 0 1 first)
  string(SUBSTRING ${name} 1 -1 rest)
  string(TOUPPER ${first} first)
  install(TARGETS ${target} EXPORT temper_${name}
          LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT libraries NAMELINK_COMPONENT development
          ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development
          FILE_SET HEADERS DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT development)
  install(EXPORT temper_${name} NAMESPACE temper:: DESTINATION ${TEMPER_CMAKE_DIR} FILE temper${first}${rest}Targets.cmake
          COMPONENT development)

  set(module temper)
  set(requires "")
  if(NOT name STREQUAL core)
    set(module temper-${name})
    set(requires "temper = ${PROJECT_VERSION}")
  endif()
  string(REPLACE ";" ", " private "${ARG_REQUIRES}")
  list(TRANSFORM ARG_LIBS PREPEND -l OUTPUT_VARIABLE libs)
  string(REPLACE ";" " " libs "${libs}")
  configure_file(${PROJECT_SOURCE_DIR}/cmake/temper.pc.in ${PROJECT_BINARY_DIR}/${module}.pc @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/${module}.pc DESTINATION ${TEMPER_PKGCONFIG_DIR} COMPONENT development)
endfunction()

temper_install(temper core "Primal-dual triangle meshes that solvers can trust: the core")

temper_install(temper_tets tets "temper's meshes of tetrahedra")
temper_install(temper_surfaces surfaces "temper's meshes of curved surfaces")

# Static libraries: whoever links the installed ones needs their libraries too, which temperConfig.cmake finds.
if(TARGET temper_io)
  target_link_libraries(temper_io PRIVATE $<INSTALL_INTERFACE:pugixml::pugixml>)
  temper_install(temper_io io "temper's mesh files" REQUIRES temper-tets temper-surfaces pugixml zlib LIBS ${CMAKE_DL_LIBS})
endif()
if(TARGET temper_lp)
  target_link_libraries(temper_lp PRIVATE $<INSTALL_INTERFACE:Clp::Clp>)
  temper_install(temper_lp lp "temper's linear and convex programs, by Clp and Eigen" REQUIRES clp)
  install(FILES ${CMAKE_CURRENT_LIST_DIR}/FindClp.cmake DESTINATION ${TEMPER_CMAKE_DIR} COMPONENT development)
endif()
if(TARGET temper_tbb)
  target_link_libraries(temper_tbb PRIVATE $<INSTALL_INTERFACE:TBB::tbb>)
  temper_install(temper_tbb tbb "temper's threads, by oneTBB" REQUIRES tbb)
endif()
if(TARGET temper_mpi)
  target_link_libraries(temper_mpi PRIVATE $<INSTALL_INTERFACE:MPI::MPI_CXX>)
  temper_install(temper_mpi mpi "temper's communicator, by MPI")
endif()
if(TARGET temper_errors)
  temper_install(temper_errors errors "Errors of solvers on temper's meshes" REQUIRES temper-surfaces temper-tets)
endif()
set(requires temper-tets)
foreach(library lp errors)
  if(TARGET temper_${library})
    list(APPEND requires temper-${library})
  endif()
endforeach()
temper_install(temper_solvers solvers "What temper's runs need from other libraries" REQUIRES ${requires})

configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/temperConfig.cmake.in ${PROJECT_BINARY_DIR}/temperConfig.cmake
                              INSTALL_DESTINATION ${TEMPER_CMAKE_DIR})
# Before 1.0 a new minor version may change the interface.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/temperConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/temperConfig.cmake ${PROJECT_BINARY_DIR}/temperConfigVersion.cmake
        DESTINATION ${TEMPER_CMAKE_DIR} COMPONENT development)

if(NOT TEMPER_DEBIAN AND NOT SKBUILD)  # which have it elsewhere
  install(FILES ${PROJECT_SOURCE_DIR}/LICENSE ${PROJECT_SOURCE_DIR}/web/report/dist/NOTICE DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)
endif()

if(PROJECT_IS_TOP_LEVEL)
  add_custom_target(uninstall VERBATIM
    COMMAND ${CMAKE_COMMAND} -DBUILD=${PROJECT_BINARY_DIR} -P ${CMAKE_CURRENT_LIST_DIR}/uninstall.cmake)
endif()
