# Windows by Debian's g++ of MinGW-w64, with threads of POSIX. Programs and Python modules have their libraries inside: each
# is one file.
set(CMAKE_SYSTEM_NAME Windows)
set(CMAKE_SYSTEM_PROCESSOR x86_64)

set(triple x86_64-w64-mingw32)
set(CMAKE_C_COMPILER ${triple}-gcc-posix)
set(CMAKE_CXX_COMPILER ${triple}-g++-posix)
set(CMAKE_RC_COMPILER ${triple}-windres)
foreach(language IN ITEMS C CXX)
  # Windows aligns stacks to 16 bytes, but GCC takes 32 and 64 for granted in code for AVX (bug 54412). So the assembler
  # replaces moves that need alignment. Here GCC also thinks that the linker takes its own copy of an inline function, and
  # keeps values in registers that another copy overwrites: -fno-ipa-ra.
  set(CMAKE_${language}_FLAGS_INIT "-Wa,-muse-unaligned-vector-move -fno-ipa-ra -D_WIN32_WINNT=0x0A00")
endforeach()
set(CMAKE_EXE_LINKER_FLAGS_INIT "-static -Wl,--stack,8388608")  # as large as Linux has it
set(CMAKE_MODULE_LINKER_FLAGS_INIT -static)
set(CMAKE_CROSSCOMPILING_EMULATOR wine)

# Nothing of the machine that compiles is of use but its programs.
set(CMAKE_FIND_ROOT_PATH /usr/${triple})
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
