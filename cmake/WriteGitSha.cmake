# Writes OUTPUT with the commit of SOURCE, "-dirty" where files that the program is built from differ from it; touches it
# only when that changes.
cmake_minimum_required(VERSION 3.25)
set(SHA unknown)
execute_process(COMMAND git -C ${SOURCE} describe --always --abbrev=12 --exclude=*
                OUTPUT_VARIABLE FOUND RESULT_VARIABLE FAILED OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
if(NOT FAILED AND FOUND)
  set(SHA ${FOUND})
  execute_process(COMMAND git -C ${SOURCE} diff --quiet HEAD -- CMakeLists.txt CMakePresets.json cmake report src
                  RESULT_VARIABLE DIFFERS)
  if(DIFFERS)
    string(APPEND SHA "-dirty")
  endif()
endif()
file(CONFIGURE OUTPUT ${OUTPUT} CONTENT "#pragma once\n#define CLUSTERBENCH_GIT_SHA \"@SHA@\"\n" @ONLY)
