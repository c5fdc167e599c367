# Compiles several sources as one (TEMPER_UNITY): a third of the time where headers and templates are the cost.
# Included last, when all targets are known. Which sources go together, cmake/unity_groups.py says.
find_package(Python3 REQUIRED COMPONENTS Interpreter)

# The sources of the targets in and below `folder`, a line a target.
function(temper_list_sources folder file)
  get_property(targets DIRECTORY ${folder} PROPERTY BUILDSYSTEM_TARGETS)
  foreach(target IN LISTS targets)
    get_target_property(type ${target} TYPE)
    if(type MATCHES "EXECUTABLE|(STATIC|SHARED|OBJECT)_LIBRARY")
      get_target_property(sources ${target} SOURCES)
      list(FILTER sources INCLUDE REGEX "\\.cpp$")
      list(TRANSFORM sources PREPEND ${folder}/ REGEX "^[^/]")
      list(LENGTH sources count)
      if(count GREATER 1)
        file(APPEND ${file} "${target};${sources}\n")
        set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
      endif()
    endif()
  endforeach()
  get_property(below DIRECTORY ${folder} PROPERTY SUBDIRECTORIES)
  foreach(next IN LISTS below)
    temper_list_sources(${next} ${file})
  endforeach()
endfunction()

set(unity_targets ${PROJECT_BINARY_DIR}/unity_targets.txt)
set(unity_groups ${PROJECT_BINARY_DIR}/unity_groups.cmake)
file(WRITE ${unity_targets} "")
foreach(folder IN LISTS TEMPER_UNITY_FOLDERS)
  cmake_path(ABSOLUTE_PATH folder BASE_DIRECTORY ${PROJECT_SOURCE_DIR} NORMALIZE)
  temper_list_sources(${folder} ${unity_targets})
endforeach()
execute_process(
  COMMAND ${Python3_EXECUTABLE} ${CMAKE_CURRENT_LIST_DIR}/unity_groups.py ${unity_targets} ${PROJECT_SOURCE_DIR}
  OUTPUT_FILE ${unity_groups} COMMAND_ERROR_IS_FATAL ANY)
include(${unity_groups})
