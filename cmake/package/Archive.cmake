# cpack runs this in place of a packer of its own, whose archives have their files in the order of the file system.
set(FILE ${CPACK_TOPLEVEL_DIRECTORY}/${CPACK_PACKAGE_FILE_NAME}${CPACK_CLUSTERBENCH_ENDING})
set(SECONDS $ENV{SOURCE_DATE_EPOCH})
if(NOT SECONDS)
  string(TIMESTAMP SECONDS "%s")
endif()
execute_process(COMMAND ${CPACK_CLUSTERBENCH_PYTHON} ${CPACK_CLUSTERBENCH_SOURCE}/packaging/archive.py
                        ${CPACK_TEMPORARY_DIRECTORY} ${FILE} ${SECONDS}
                COMMAND_ERROR_IS_FATAL ANY)
set(CPACK_EXTERNAL_BUILT_PACKAGES ${FILE})
