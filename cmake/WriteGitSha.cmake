# Writes OUTPUT with the commit of SOURCE, "-dirty" where tracked files differ from it; touches it only when that changes.
cmake_minimum_required(VERSION 3.25)
set(SHA unknown)
execute_process(COMMAND git -C ${SOURCE} describe --always --dirty --abbrev=12 --exclude=*
                OUTPUT_VARIABLE FOUND RESULT_VARIABLE FAILED OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
if(NOT FAILED AND FOUND)
  set(SHA ${FOUND})
endif()
file(CONFIGURE OUTPUT ${OUTPUT} CONTENT "#pragma once\n#define CLUSTERBENCH_GIT_SHA \"@SHA@\"\n" @ONLY)
