# pybind11: the installed one, or a newer one from PyPI. A module that pybind11 < 2.12 has built refuses NumPy 2, and Debian
# 12 has 2.10. The newer one is headers alone, in the build folder. Debian packages take Debian's.
#
# Without pip or network the installed one is taken, and a message says what the module then lacks.
set(temper_pybind11_wanted 2.12)    # the first for NumPy 2
set(temper_pybind11_version 3.0.1)  # as in scripts/wheels.sh
set(temper_pybind11_folder ${PROJECT_BINARY_DIR}/pybind11-${temper_pybind11_version})

find_package(pybind11 ${temper_pybind11_wanted} CONFIG QUIET)
if(NOT pybind11_FOUND AND NOT TEMPER_DEBIAN)
  message(STATUS "pybind11 ${temper_pybind11_version} is taken from PyPI: the installed one is too old for NumPy 2")
  foreach(python IN ITEMS ${Python_EXECUTABLE} python3 /usr/bin/python3)
    execute_process(
      COMMAND ${python} -m pip install --quiet --disable-pip-version-check --no-deps --retries 1 --timeout 20
              --only-binary :all: --target ${temper_pybind11_folder} pybind11==${temper_pybind11_version}
      RESULT_VARIABLE failed OUTPUT_QUIET ERROR_VARIABLE why ERROR_STRIP_TRAILING_WHITESPACE)
    if(NOT failed)
      set(pybind11_DIR ${temper_pybind11_folder}/pybind11/share/cmake/pybind11 CACHE PATH "pybind11Config.cmake" FORCE)
      find_package(pybind11 ${temper_pybind11_wanted} CONFIG QUIET)
      break()
    endif()
    file(REMOVE_RECURSE ${temper_pybind11_folder})
  endforeach()
endif()
if(NOT pybind11_FOUND)
  find_package(pybind11 2.10 REQUIRED CONFIG)
  if(NOT TEMPER_DEBIAN)
    string(REGEX REPLACE ".*\n" "" why "${why}")
    message(WARNING "pybind11 is ${pybind11_VERSION}, so the Python module will work with NumPy 1 alone. "
                    "pip could not get pybind11 ${temper_pybind11_version}: ${why}\n"
                    "Next: configure again with a network, or with -Dpybind11_DIR=FOLDER for a pybind11 of at least "
                    "${temper_pybind11_wanted}, whose folder 'python3 -m pybind11 --cmakedir' prints")
  endif()
endif()
