# clusterbench_install(): `cmake --install` puts documents, levels and configurations beside the program, and the manual page and
# the shells' completions, which it writes itself. (The program's own rule is in ClusterbenchLayers.cmake.)
include(GNUInstallDirs)

function(clusterbench_install_output ARGUMENTS FOLDER NAME)
  set(EMULATOR "") # a program for another processor or system
  foreach(PART ${CMAKE_CROSSCOMPILING_EMULATOR})
    string(APPEND EMULATOR "\"${PART}\" ")
  endforeach()
  install(CODE "
    set(FILE \"${CMAKE_CURRENT_BINARY_DIR}/install/${NAME}\")
    file(MAKE_DIRECTORY \"${CMAKE_CURRENT_BINARY_DIR}/install\")
    execute_process(COMMAND ${EMULATOR} \"$<TARGET_FILE:clusterbench>\" ${ARGUMENTS} OUTPUT_FILE \"\${FILE}\" COMMAND_ERROR_IS_FATAL ANY)
    file(INSTALL DESTINATION \"\${CMAKE_INSTALL_PREFIX}/${FOLDER}\" TYPE FILE FILES \"\${FILE}\")")
endfunction()

function(clusterbench_install)
  install(FILES ${PROJECT_SOURCE_DIR}/LICENSE ${PROJECT_SOURCE_DIR}/README.md ${PROJECT_SOURCE_DIR}/CHANGELOG.md
          DESTINATION ${CMAKE_INSTALL_DOCDIR})
  # Configurations name levels by ../scenes. Those whose lights are in scenes/peers stay behind with them.
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/configs ${PROJECT_SOURCE_DIR}/scenes DESTINATION ${CMAKE_INSTALL_DATADIR}/clusterbench
          PATTERN peers EXCLUDE PATTERN "gpu*.json" EXCLUDE PATTERN method-pictures.json EXCLUDE)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/docs DESTINATION ${CMAKE_INSTALL_DOCDIR} FILES_MATCHING PATTERN "*.md")
  if(WIN32)
    return() # which has neither man nor these shells
  endif()
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/scripts/slurm DESTINATION ${CMAKE_INSTALL_DATADIR}/clusterbench USE_SOURCE_PERMISSIONS)
  clusterbench_install_output("man" ${CMAKE_INSTALL_MANDIR}/man1 clusterbench.1)
  clusterbench_install_output("completion bash" ${CMAKE_INSTALL_DATADIR}/bash-completion/completions clusterbench)
  clusterbench_install_output("completion zsh" ${CMAKE_INSTALL_DATADIR}/zsh/site-functions _clusterbench)
  clusterbench_install_output("completion fish" ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d clusterbench.fish)
endfunction()
