# Clp, COIN-OR's linear programming solver: Clp::Clp. Found by pkg-config where there is one, else by name.
find_package(PkgConfig QUIET)
if(PKG_CONFIG_FOUND)
  pkg_check_modules(PC_Clp QUIET clp)
endif()

# The headers are included as <coin/Clp…>: Debian's folder. Homebrew has it in a folder clp. vcpkg calls it coin-or.
find_path(Clp_INCLUDE_DIR coin/Clp_C_Interface.h HINTS ${PC_Clp_INCLUDE_DIRS} ${PC_Clp_INCLUDEDIR} PATH_SUFFIXES clp)
if(NOT Clp_INCLUDE_DIR)
  find_path(Clp_OTHER_INCLUDE_DIR coin-or/Clp_C_Interface.h HINTS ${PC_Clp_INCLUDE_DIRS} ${PC_Clp_INCLUDEDIR})
  mark_as_advanced(Clp_OTHER_INCLUDE_DIR)
  if(Clp_OTHER_INCLUDE_DIR)
    set(Clp_INCLUDE_DIR ${CMAKE_BINARY_DIR}/clp)
    file(WRITE ${Clp_INCLUDE_DIR}/coin/Clp_C_Interface.h "#include \"${Clp_OTHER_INCLUDE_DIR}/coin-or/Clp_C_Interface.h\"\n")
  endif()
endif()
find_library(Clp_LIBRARY Clp HINTS ${PC_Clp_LIBRARY_DIRS})
find_library(Clp_CoinUtils_LIBRARY CoinUtils HINTS ${PC_Clp_LIBRARY_DIRS})
mark_as_advanced(Clp_INCLUDE_DIR Clp_LIBRARY Clp_CoinUtils_LIBRARY)

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(Clp REQUIRED_VARS Clp_LIBRARY Clp_CoinUtils_LIBRARY Clp_INCLUDE_DIR
                                  VERSION_VAR PC_Clp_VERSION)

if(Clp_FOUND AND NOT TARGET Clp::Clp)
  add_library(Clp::Clp UNKNOWN IMPORTED)
  # Clp's headers find one another, and those of CoinUtils, beside themselves. Homebrew has the latter in
  # another folder, which pkg-config names.
  set_target_properties(Clp::Clp PROPERTIES
    IMPORTED_LOCATION "${Clp_LIBRARY}"
    INTERFACE_INCLUDE_DIRECTORIES "${Clp_INCLUDE_DIR};${Clp_INCLUDE_DIR}/coin;${PC_Clp_INCLUDE_DIRS}"
    INTERFACE_LINK_LIBRARIES "${Clp_CoinUtils_LIBRARY}")
endif()
