# cmake -DSOURCE=… -DOUTPUT=… -P commit.cmake: writes commit.cpp if it is out of date.
#
# A folder within some other clone, such as an unpacked archive, has no commit of its own.
find_program(git git)
set(commit "unknown")
if(git)
  execute_process(COMMAND ${git} -C ${SOURCE} rev-parse --show-toplevel OUTPUT_VARIABLE top ERROR_QUIET OUTPUT_STRIP_TRAILING_WHITESPACE)
  file(REAL_PATH "${SOURCE}" source)
  if(top STREQUAL source)
    execute_process(COMMAND ${git} -C ${SOURCE} rev-parse --short=12 HEAD
                    OUTPUT_VARIABLE commit RESULT_VARIABLE failed ERROR_QUIET OUTPUT_STRIP_TRAILING_WHITESPACE)
    execute_process(COMMAND ${git} -C ${SOURCE} status --porcelain --untracked-files=no
                    OUTPUT_VARIABLE changes ERROR_QUIET OUTPUT_STRIP_TRAILING_WHITESPACE)
    if(failed)
      set(commit "unknown")
    elseif(changes)
      string(APPEND commit ", with changes")
    endif()
  endif()
endif()

set(text "#include \"build_info/commit.hpp\"\n\nnamespace temper {\nstd::string_view commit() { return \"${commit}\"; }\n}\n")
set(former "")
if(EXISTS ${OUTPUT})
  file(READ ${OUTPUT} former)
endif()
if(NOT former STREQUAL text)
  file(WRITE ${OUTPUT} "${text}")
endif()
