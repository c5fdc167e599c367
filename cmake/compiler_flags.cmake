# The flags of temper's own code, each tried with the compiler that is there.
include(CheckCXXCompilerFlag)

# Flags that the compiler does not know are left out of the list that is called VARIABLE.
function(temper_known_flags variable)
  set(known "")
  foreach(flag IN LISTS ARGN)
    string(MAKE_C_IDENTIFIER "TEMPER_HAS${flag}" has)
    string(REGEX REPLACE "^-Wno-" "-W" tried ${flag})  # GCC takes any -Wno-
    set(CMAKE_REQUIRED_QUIET ON)
    check_cxx_compiler_flag(${tried} ${has})
    if(${has})
      list(APPEND known ${flag})
    endif()
  endforeach()
  set(${variable} ${known} PARENT_SCOPE)
endfunction()

# Contraction would change the signs of the predicates; see geometry/.
if(MSVC AND CMAKE_CXX_COMPILER_ID STREQUAL Clang)
  temper_known_flags(temper_exact /clang:-ffp-contract=off)
elseif(MSVC)
  set(temper_exact /fp:precise)  # since Visual Studio 2022 this contracts nothing
else()
  temper_known_flags(temper_exact -ffp-contract=off)
endif()
if(NOT temper_exact)
  message(FATAL_ERROR "the compiler has no -ffp-contract=off, without which the predicates of temper are not exact")
endif()
set(temper_silenced "")
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)  # GCC 12 takes concatenations of std::string for overflows (bugs 105329, 105651).
  set(temper_silenced -Wno-restrict -Wno-array-bounds -Wno-stringop-overflow -Wno-stringop-overread)
elseif(CMAKE_CXX_COMPILER_ID STREQUAL Clang)
  # std::stable_sort of GCC 12's library calls what C++17 deprecates, and clang says so at the call.
  set(temper_silenced -Wno-deprecated-declarations)
endif()
if(MSVC)
  set(temper_warnings /W3)
else()
  temper_known_flags(temper_warnings -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion ${temper_silenced})
endif()
add_library(temper_flags INTERFACE)
if(MSVC)
  target_compile_options(temper_flags INTERFACE /utf-8 /bigobj /Zc:__cplusplus)
  target_compile_definitions(temper_flags INTERFACE NOMINMAX)
endif()
target_compile_options(temper_flags INTERFACE ${temper_exact} ${temper_warnings} $<$<BOOL:${TEMPER_WERROR}>:-Werror>)

# Instruction sets of x86. AVX-512 has 32 registers, enough to order instructions before they are given out: divisions and
# roots take long, and much can go on meanwhile. GCC leaves that out on x86, whose other sets have 16.
set(TEMPER_X86_SETS OFF)
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  temper_known_flags(TEMPER_AVX2_OPTIONS -mavx2)
  temper_known_flags(TEMPER_AVX512_OPTIONS -mavx512f -mavx512dq)
  if(TEMPER_AVX2_OPTIONS STREQUAL "-mavx2" AND TEMPER_AVX512_OPTIONS STREQUAL "-mavx512f;-mavx512dq")
    set(TEMPER_X86_SETS ON)
    temper_known_flags(temper_order -fschedule-insns -fsched-pressure)  # clang has neither
    list(APPEND TEMPER_AVX512_OPTIONS ${temper_order})
  endif()
endif()
