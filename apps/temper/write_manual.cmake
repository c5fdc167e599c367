# cmake -DPROGRAM=… -DFOLDER=… -P write_manual.cmake: runs the program, which writes its manual pages and completions to
# FOLDER/man1 and FOLDER/completions. -DGZIP=1: pages are compressed, as in Debian.
function(write_help file)
  execute_process(COMMAND ${PROGRAM} ${ARGN} OUTPUT_FILE ${FOLDER}/${file} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

file(REMOVE_RECURSE ${FOLDER})
file(MAKE_DIRECTORY ${FOLDER}/man1 ${FOLDER}/completions)
write_help(completions/temper --help=bash)
write_help(completions/_temper --help=zsh)
write_help(completions/temper.fish --help=fish)

write_help(man1/temper.1 --help=man)
file(STRINGS ${FOLDER}/man1/temper.1 others REGEX "^\\.BR temper..[a-z]+ \\(1\\)")
foreach(line IN LISTS others)
  string(REGEX REPLACE "^\\.BR temper..([a-z]+) .*" "\\1" verb "${line}")
  write_help(man1/temper-${verb}.1 ${verb} --help=man)
endforeach()

if(GZIP)
  file(GLOB pages ${FOLDER}/man1/*)
  execute_process(COMMAND gzip -9n ${pages} COMMAND_ERROR_IS_FATAL ANY)
endif()
