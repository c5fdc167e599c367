# TEMPER_CROSS_LIBRARIES: the libraries of others, compiled into temper from Debian's source archives. So a wheel brings none along,
# and a compiler for another system needs nothing of that system.
#
# fetch_sources.sh brings the archives into the folder TEMPER_SOURCES. find_package() then finds these targets by redirects
# (CMAKE_FIND_PACKAGE_REDIRECTS_DIR), and the rest of the build does not see the difference. TEMPER_LICENSES is a folder with the
# licenses of what is then inside temper, a file NAME_VERSION.txt for each.
enable_language(C)
set(TEMPER_SOURCES ${PROJECT_SOURCE_DIR}/build/archives CACHE PATH "Folder of source archives, which fetch_sources.sh fills")
execute_process(COMMAND ${CMAKE_CURRENT_LIST_DIR}/fetch_sources.sh ${TEMPER_SOURCES} COMMAND_ERROR_IS_FATAL ANY)
set(unpacked ${PROJECT_BINARY_DIR}/bundled)
set(TEMPER_LICENSES ${PROJECT_BINARY_DIR}/licenses)
file(REMOVE_RECURSE ${TEMPER_LICENSES})

function(temper_license name version sources file)
  file(READ "${file}" text)
  file(WRITE ${TEMPER_LICENSES}/${name}_${version}.txt "${name} ${version}. Sources: ${sources}\n\n${text}")
endfunction()

# A library that comes with the compiler, and whose license asks for its text. LLVM's does not.
function(temper_license_of_debian package)
  execute_process(COMMAND dpkg-query -W -f "\${Version}" ${package} OUTPUT_VARIABLE version COMMAND_ERROR_IS_FATAL ANY)
  string(REGEX REPLACE "^[0-9]+:" "" version ${version})
  temper_license(${package} ${version} https://packages.debian.org/${package} /usr/share/doc/${package}/copyright)
endfunction()

# What PACKAGE's archive has in its one folder: <PACKAGE>_folder and <PACKAGE>_version. LICENSE: a file. ARGN: the other parts.
function(temper_unpack package license)
  file(GLOB archive ${TEMPER_SOURCES}/${package}_*.orig.tar.*)
  string(REGEX REPLACE ".*_([0-9.]+[0-9]).*\\.orig\\.tar.*" "\\1" version ${archive})
  file(GLOB unpacked_license ${unpacked}/${package}/*/${license})
  if(NOT unpacked_license)
    list(TRANSFORM ARGN PREPEND "*/" OUTPUT_VARIABLE patterns)
    list(APPEND patterns "*/${license}")
    file(ARCHIVE_EXTRACT INPUT ${archive} DESTINATION ${unpacked}/${package} PATTERNS ${patterns})
  endif()
  file(GLOB folder ${unpacked}/${package}/*)
  temper_license(${package} ${version} https://sources.debian.org/src/${package} ${folder}/${license})
  set(${package}_folder ${folder} PARENT_SCOPE)
  set(${package}_version ${version} PARENT_SCOPE)
endfunction()

# find_package(NAME) finds that version.
function(temper_found name version)
  set(config ${CMAKE_FIND_PACKAGE_REDIRECTS_DIR}/${name})
  file(WRITE ${config}Config.cmake "")
  file(WRITE ${config}ConfigVersion.cmake "set(PACKAGE_VERSION ${version})\nset(PACKAGE_VERSION_COMPATIBLE TRUE)\n")
endfunction()

# A library in its authors' style: each source alone, no warnings. Only what something needs is compiled.
function(temper_bundled target alias folder)
  add_library(${target} STATIC EXCLUDE_FROM_ALL ${ARGN})
  add_library(${alias} ALIAS ${target})
  target_include_directories(${target} SYSTEM PUBLIC ${folder})
  target_compile_options(${target} PRIVATE -w)
  set_target_properties(${target} PROPERTIES UNITY_BUILD OFF POSITION_INDEPENDENT_CODE ON CXX_STANDARD 14
                        C_VISIBILITY_PRESET hidden CXX_VISIBILITY_PRESET hidden)
endfunction()

function(temper_bundled_headers alias folder)
  add_library(${alias} INTERFACE IMPORTED GLOBAL)
  target_include_directories(${alias} SYSTEM INTERFACE ${folder})
endfunction()

temper_unpack(pugixml LICENSE.md src)
temper_bundled(temper_pugixml pugixml::pugixml ${pugixml_folder}/src ${pugixml_folder}/src/pugixml.cpp)
temper_found(pugixml ${pugixml_version})

temper_unpack(zlib LICENSE "*.c" "*.h")
set(sources adler32 compress crc32 deflate inffast inflate inftrees trees uncompr zutil)
list(TRANSFORM sources REPLACE "(.+)" "${zlib_folder}/\\1.c")
temper_bundled(temper_zlib ZLIB::ZLIB ${zlib_folder} ${sources})
target_compile_definitions(temper_zlib PRIVATE fdopen=fdopen)  # which zlib 1.2 takes for missing on macOS
temper_found(ZLIB ${zlib_version})

temper_unpack(nlohmann-json3 LICENSE.MIT include)
temper_bundled_headers(nlohmann_json::nlohmann_json ${nlohmann-json3_folder}/include)
temper_found(nlohmann_json ${nlohmann-json3_version})

temper_unpack(eigen3 COPYING.MPL2 Eigen unsupported)
temper_bundled_headers(Eigen3::Eigen ${eigen3_folder})
temper_found(Eigen3 ${eigen3_version})

if(TEMPER_BUILD_WASM)
  temper_license_of_debian(wasi-libc)
  return()
elseif(MINGW)
  temper_license_of_debian(mingw-w64-x86-64-dev)
  temper_license_of_debian(gcc-mingw-w64-x86-64-posix-runtime)
endif()

temper_unpack(cli11 LICENSE include)
temper_bundled_headers(CLI11::CLI11 ${cli11_folder}/include)
temper_found(CLI11 ${cli11_version})

temper_unpack(fmtlib LICENSE.rst include)
temper_bundled_headers(fmt::fmt ${fmtlib_folder}/include)
target_compile_definitions(fmt::fmt INTERFACE FMT_HEADER_ONLY)
temper_found(fmt ${fmtlib_version})

# Clp with CoinUtils, without the programs of both and without the solvers that Clp can call. The headers that their
# `configure` would write:
temper_unpack(coinutils CoinUtils/LICENSE CoinUtils/src)
temper_unpack(clp Clp/LICENSE Clp/src)
set(coin ${unpacked}/coin)
file(WRITE ${coin}/config_coinutils.h
     "#define COINUTILS_VERSION \"${coinutils_version}\"\n#define COINUTILS_HAS_CSTDINT 1\n#define COIN_INT64_T int64_t\n"
     "#define COIN_UINT64_T uint64_t\n#define COIN_INTPTR_T intptr_t\n")
configure_file(${clp_folder}/Clp/src/config_clp_default.h ${coin}/config_clp.h COPYONLY)
file(WRITE ${coin}/config.h
     "#include \"config_coinutils.h\"\n#include \"config_clp.h\"\n#define HAVE_CMATH 1\n#define HAVE_CFLOAT 1\n"
     "#define COIN_C_FINITE std::isfinite\n#define COIN_C_ISNAN std::isnan\n#define COIN_HAS_COINUTILS 1\n"
     "#define COIN_HAS_CLP 1\n#define COIN_CLP_CHECKLEVEL 0\n#define COIN_CLP_VERBOSITY 0\n"
     "#define COIN_COINUTILS_CHECKLEVEL 0\n#define COIN_COINUTILS_VERBOSITY 0\n")
file(COPY ${coinutils_folder}/CoinUtils/src/Coin_C_defines.h ${clp_folder}/Clp/src/Clp_C_Interface.h DESTINATION ${coin}/coin)
file(GLOB sources ${coinutils_folder}/CoinUtils/src/*.cpp ${clp_folder}/Clp/src/Clp*.cpp ${clp_folder}/Clp/src/Idi*.cpp)
list(FILTER sources EXCLUDE REGEX "ClpMain|ClpCholesky(Mumps|Ufl|Wssmp|Taucs)|ClpSolver\\.|_ampl|Test")
temper_bundled(temper_clp Clp::Clp ${coin} ${sources})
target_include_directories(temper_clp PRIVATE ${coin} ${coinutils_folder}/CoinUtils/src ${clp_folder}/Clp/src)
target_compile_definitions(temper_clp PRIVATE HAVE_CONFIG_H COINUTILS_BUILD CLP_BUILD)
temper_found(Clp ${clp_version})

temper_unpack(onetbb LICENSE.txt include src/tbb)
file(GLOB sources ${onetbb_folder}/src/tbb/*.cpp)
temper_bundled(temper_onetbb TBB::tbb ${onetbb_folder}/include ${sources})
target_compile_definitions(temper_onetbb PRIVATE __TBB_BUILD __TBB_DYNAMIC_LOAD_ENABLED=0 __TBB_SOURCE_DIRECTLY_INCLUDED=1)
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  target_compile_options(temper_onetbb PRIVATE -mrtm -mwaitpkg)
endif()
if(APPLE)
  target_compile_definitions(temper_onetbb PRIVATE _XOPEN_SOURCE)  # for ucontext.h
endif()
set(THREADS_PREFER_PTHREAD_FLAG ON)
find_package(Threads REQUIRED)
target_link_libraries(temper_onetbb PUBLIC Threads::Threads ${CMAKE_DL_LIBS})
temper_found(TBB ${onetbb_version})

# The headers alone: both libraries are loaded at run time.
if(EXISTS ${TEMPER_SOURCES}/headers/netcdf)
  temper_bundled_headers(NetCDF::NetCDF ${TEMPER_SOURCES}/headers/netcdf)
  temper_found(NetCDF 4.9)
endif()
if(EXISTS ${TEMPER_SOURCES}/headers/hdf5)
  temper_bundled_headers(HDF5::headers ${TEMPER_SOURCES}/headers/hdf5)
  if(NOT CMAKE_SYSTEM_NAME STREQUAL Linux)
    file(WRITE ${unpacked}/linux/features.h "")  # of Linux, where these headers were configured
    target_include_directories(HDF5::headers SYSTEM INTERFACE ${unpacked}/linux)
  endif()
  temper_found(HDF5Headers 1.10)
endif()

if(TEMPER_BUILD_TESTS)
  set(googletest /usr/src/googletest/googletest)  # of libgtest-dev
  temper_bundled(temper_gtest GTest::gtest "${googletest};${googletest}/include" ${googletest}/src/gtest-all.cc)
  temper_bundled(temper_gtest_main GTest::gtest_main ${googletest}/include ${googletest}/src/gtest_main.cc)
  target_link_libraries(temper_gtest PUBLIC Threads::Threads)
  target_link_libraries(temper_gtest_main PUBLIC temper_gtest)
  temper_found(GTest 1)
endif()
