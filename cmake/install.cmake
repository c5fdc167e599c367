# Installs the libraries and what find_package(temper COMPONENTS core io lp tbb verify) needs. The flags of temper's own
# code (temper_flags) stay here: they are linked for the build alone and are in no export.
include(CMakePackageConfigHelpers)

set(TEMPER_CMAKE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/temper)

install(TARGETS temper EXPORT temper_core)
install(EXPORT temper_core NAMESPACE temper:: DESTINATION ${TEMPER_CMAKE_DIR} FILE temperCoreTargets.cmake)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/temper DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
        FILES_MATCHING PATTERN "*.hpp" PATTERN "io.hpp" EXCLUDE PATTERN "checkpoint.hpp" EXCLUDE PATTERN "dec_io.hpp" EXCLUDE PATTERN "lp.hpp" EXCLUDE
        PATTERN "tbb_executor.hpp" EXCLUDE PATTERN "verify.hpp" EXCLUDE)

if(TARGET temper_io)
  # A static library: whoever links the installed one needs pugixml too. temperConfig.cmake finds it.
  target_link_libraries(temper_io PRIVATE $<INSTALL_INTERFACE:pugixml::pugixml>)
  set_target_properties(temper_io PROPERTIES EXPORT_NAME io)
  install(TARGETS temper_io EXPORT temper_io)
  install(EXPORT temper_io NAMESPACE temper:: DESTINATION ${TEMPER_CMAKE_DIR} FILE temperIoTargets.cmake)
  install(FILES ${PROJECT_SOURCE_DIR}/include/temper/io.hpp ${PROJECT_SOURCE_DIR}/include/temper/dec_io.hpp
                ${PROJECT_SOURCE_DIR}/include/temper/checkpoint.hpp
          DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/temper)
  if(temper_io_netcdf)
    install(FILES ${CMAKE_CURRENT_LIST_DIR}/FindNetCDF.cmake DESTINATION ${TEMPER_CMAKE_DIR})
  endif()
endif()

if(TARGET temper_lp)
  target_link_libraries(temper_lp PRIVATE $<INSTALL_INTERFACE:Clp::Clp>)
  install(TARGETS temper_lp EXPORT temper_lp)
  install(EXPORT temper_lp NAMESPACE temper:: DESTINATION ${TEMPER_CMAKE_DIR} FILE temperLpTargets.cmake)
  install(FILES ${PROJECT_SOURCE_DIR}/include/temper/lp.hpp DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/temper)
  install(FILES ${CMAKE_CURRENT_LIST_DIR}/FindClp.cmake DESTINATION ${TEMPER_CMAKE_DIR})
endif()

if(TARGET temper_tbb)
  target_link_libraries(temper_tbb PRIVATE $<INSTALL_INTERFACE:TBB::tbb>)
  install(TARGETS temper_tbb EXPORT temper_tbb)
  install(EXPORT temper_tbb NAMESPACE temper:: DESTINATION ${TEMPER_CMAKE_DIR} FILE temperTbbTargets.cmake)
  install(FILES ${PROJECT_SOURCE_DIR}/include/temper/tbb_executor.hpp DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/temper)
endif()

if(TARGET temper_verify)
  install(TARGETS temper_verify EXPORT temper_verify)
  install(EXPORT temper_verify NAMESPACE temper:: DESTINATION ${TEMPER_CMAKE_DIR} FILE temperVerifyTargets.cmake)
  install(FILES ${PROJECT_SOURCE_DIR}/include/temper/verify.hpp DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/temper)
endif()

configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/temperConfig.cmake.in ${PROJECT_BINARY_DIR}/temperConfig.cmake
                              INSTALL_DESTINATION ${TEMPER_CMAKE_DIR})
# Before 1.0 a new minor version may change the interface.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/temperConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/temperConfig.cmake ${PROJECT_BINARY_DIR}/temperConfigVersion.cmake
        DESTINATION ${TEMPER_CMAKE_DIR})
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
