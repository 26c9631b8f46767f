# cmake -D PROGRAM=... -D OUT=... -P HelpFiles.cmake: OUT/man/man1/*.1.gz and completion scripts, in the places of a Debian
# system's /usr/share. The verbs are those that promenade(1) names.
function(write_output file)
  execute_process(COMMAND ${PROGRAM} ${ARGN} OUTPUT_VARIABLE text COMMAND_ERROR_IS_FATAL ANY)
  file(WRITE ${OUT}/${file} "${text}")
endfunction()

file(REMOVE_RECURSE ${OUT})
write_output(bash-completion/completions/promenade completion bash)
write_output(zsh/vendor-completions/_promenade completion zsh)
write_output(man/man1/promenade.1 man)
file(READ ${OUT}/man/man1/promenade.1 main_page)
string(REGEX MATCHALL "promenade.-[a-z]+ .1.\n?" pages "${main_page}")
foreach(page IN LISTS pages)
  string(REGEX REPLACE "promenade.-([a-z]+) .*" "\\1" verb "${page}")
  write_output(man/man1/promenade-${verb}.1 man ${verb})
endforeach()
file(GLOB pages ${OUT}/man/man1/*.1)
execute_process(COMMAND gzip -9nf ${pages} COMMAND_ERROR_IS_FATAL ANY)
