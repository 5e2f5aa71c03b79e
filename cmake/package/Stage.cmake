# cpack runs this when all files are in the folder that it is about to pack.
set(KIND archive)
if(CPACK_GENERATOR STREQUAL "DEB")
  set(KIND deb)
endif()
execute_process(COMMAND ${CPACK_CLUSTERBENCH_PYTHON} ${CPACK_CLUSTERBENCH_SOURCE}/packaging/stage.py ${KIND}
                        ${CPACK_TEMPORARY_DIRECTORY} ${CPACK_CLUSTERBENCH_FACTS}
                COMMAND_ERROR_IS_FATAL ANY)
