# pugixml and zlib for WebAssembly, compiled from Debian's source archives, which fetch_sources.sh brings into the build
# folder: the same versions as the native program has, so that compressed files have the same bytes.
enable_language(C)

set(sources ${PROJECT_BINARY_DIR}/sources)
execute_process(COMMAND ${CMAKE_CURRENT_LIST_DIR}/fetch_sources.sh ${sources}/archives pugixml zlib
                COMMAND_ERROR_IS_FATAL ANY)
foreach(package IN ITEMS pugixml zlib)
  if(NOT IS_DIRECTORY ${sources}/${package})
    file(GLOB archive ${sources}/archives/${package}_*.orig.tar.*)
    file(ARCHIVE_EXTRACT INPUT ${archive} DESTINATION ${sources}/${package})
  endif()
  file(GLOB ${package}_folder ${sources}/${package}/*)  # the one folder of the archive
endforeach()

add_library(temper_pugixml STATIC ${pugixml_folder}/src/pugixml.cpp)
target_include_directories(temper_pugixml SYSTEM PUBLIC ${pugixml_folder}/src)
add_library(pugixml::pugixml ALIAS temper_pugixml)

set(zlib_sources adler32 compress crc32 deflate inffast inflate inftrees trees uncompr zutil)
list(TRANSFORM zlib_sources REPLACE "(.+)" "${zlib_folder}/\\1.c")
add_library(temper_zlib STATIC ${zlib_sources})
target_include_directories(temper_zlib SYSTEM PUBLIC ${zlib_folder})
add_library(ZLIB::ZLIB ALIAS temper_zlib)

# Their authors' style, each source alone.
set_target_properties(temper_pugixml temper_zlib PROPERTIES UNITY_BUILD OFF)
target_compile_options(temper_zlib PRIVATE -w)

# Eigen is headers alone, in a folder of their own.
find_path(temper_eigen_folder Eigen/SparseCholesky PATHS /usr/include/eigen3 /usr/local/include/eigen3 NO_CMAKE_FIND_ROOT_PATH REQUIRED)
add_library(Eigen3::Eigen INTERFACE IMPORTED GLOBAL)
target_include_directories(Eigen3::Eigen SYSTEM INTERFACE ${temper_eigen_folder})

# nlohmann's headers lie among those of the machine, which are not for this target: a folder that has them alone.
find_path(temper_json_folder nlohmann/json.hpp PATHS /usr/include /usr/local/include NO_CMAKE_FIND_ROOT_PATH REQUIRED)
file(MAKE_DIRECTORY ${sources}/json)
file(CREATE_LINK ${temper_json_folder}/nlohmann ${sources}/json/nlohmann SYMBOLIC)
add_library(temper_json INTERFACE)
target_include_directories(temper_json SYSTEM INTERFACE ${sources}/json)
