# Clang and libc++ for another system, by the compiler `zig c++` of the Python package ziglang (scripts/cross.sh).
#   TEMPER_ZIG_TARGET   aarch64-macos, x86_64-macos, x86_64-linux-gnu.2.28, aarch64-linux-gnu.2.28 (oldest glibc)
list(APPEND CMAKE_TRY_COMPILE_PLATFORM_VARIABLES TEMPER_ZIG_TARGET)
get_filename_component(zig ${CMAKE_CURRENT_LIST_DIR}/../../build/zig ABSOLUTE)
if(NOT EXISTS ${zig}/ziglang/zig)
  file(WRITE ${zig}/requirements.txt
       "ziglang==0.17.1 --hash=sha256:ea6cc5d87b033cf0aedfbc8f9549a908cae6c50ac31f1698188fa48a74524b54\n")  # for Linux on x86-64
  execute_process(COMMAND python3 -m pip install --quiet --no-cache-dir --target ${zig} --require-hashes -r ${zig}/requirements.txt
                  COMMAND_ERROR_IS_FATAL ANY)
endif()
string(REGEX MATCH "^([^-]+)-([^-]+)" ignored ${TEMPER_ZIG_TARGET})
set(CMAKE_SYSTEM_PROCESSOR ${CMAKE_MATCH_1})
if(CMAKE_MATCH_2 STREQUAL macos)
  set(CMAKE_SYSTEM_NAME Darwin)
  set(CMAKE_OSX_SYSROOT "")                # zig has the headers and libraries of the system
  set(CMAKE_INSTALL_NAME_TOOL /bin/true)   # nothing is installed with other paths
else()
  set(CMAKE_SYSTEM_NAME Linux)
  foreach(kind IN ITEMS EXE SHARED MODULE)
    set(CMAKE_${kind}_LINKER_FLAGS_INIT -s)  # zig adds debug information, and strip knows this machine's files alone
  endforeach()
  if(NOT CMAKE_HOST_SYSTEM_PROCESSOR STREQUAL CMAKE_SYSTEM_PROCESSOR)
    set(CMAKE_CROSSCOMPILING_EMULATOR qemu-${CMAKE_SYSTEM_PROCESSOR} -L /usr/${CMAKE_SYSTEM_PROCESSOR}-linux-gnu)
  endif()
endif()

# CMake and ccache expect programs without arguments of their own.
set(tools ${zig}/${TEMPER_ZIG_TARGET})
foreach(tool IN ITEMS "cc -target ${TEMPER_ZIG_TARGET}" "c++ -target ${TEMPER_ZIG_TARGET}" ar ranlib)
  string(REGEX MATCH "^[^ ]+" name ${tool})
  file(CONFIGURE OUTPUT ${tools}/${name} CONTENT "#!/bin/sh\nexec ${zig}/ziglang/zig ${tool} \"$@\"\n")
  file(CHMOD ${tools}/${name} PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
endforeach()
set(CMAKE_C_COMPILER ${tools}/cc)
set(CMAKE_CXX_COMPILER ${tools}/c++)
set(CMAKE_AR ${tools}/ar)
set(CMAKE_RANLIB ${tools}/ranlib)
foreach(language IN ITEMS C CXX)
  set(CMAKE_${language}_FLAGS_INIT "-fno-sanitize=undefined")  # zig's default
endforeach()

# Nothing of the machine that compiles is of use, except programs.
set(CMAKE_FIND_ROOT_PATH ${tools})
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
