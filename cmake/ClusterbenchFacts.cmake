# clusterbench_facts(TARGET): what src/run/tool_facts.cpp says of the build. The commit is read anew at every build, so that it is
# never that of an earlier configure.
function(clusterbench_facts TARGET)
  string(TOUPPER "${CMAKE_BUILD_TYPE}" TYPE)
  string(STRIP "${CMAKE_CXX_FLAGS} ${CMAKE_CXX_FLAGS_${TYPE}} -ffp-contract=off" FLAGS)
  set(LIBRARIES "")  # those whose headers tool_facts.cpp cannot ask
  foreach(NAME Boost TBB embree NLopt)
    set(VERSION ${${NAME}_VERSION})
    string(TOUPPER ${NAME} OPTION)
    if(VERSION AND (NAME STREQUAL Boost OR CLUSTERBENCH_HAS_${OPTION}))
      string(TOLOWER ${NAME} LOWER)
      string(APPEND LIBRARIES "{\"${LOWER}\", \"${VERSION}\"},")
    endif()
  endforeach()
  set_property(SOURCE src/run/tool_facts.cpp PROPERTY COMPILE_DEFINITIONS "CLUSTERBENCH_LIBRARIES=${LIBRARIES}")
  set_property(SOURCE src/run/tool_facts.cpp APPEND PROPERTY COMPILE_DEFINITIONS
    "CLUSTERBENCH_VERSION=\"${PROJECT_VERSION}\";CLUSTERBENCH_FLAGS=\"${FLAGS}\";CLUSTERBENCH_BUILD_TYPE=\"${CMAKE_BUILD_TYPE}\"")
  set_property(SOURCE src/plugin/plugins.cpp PROPERTY COMPILE_DEFINITIONS "CLUSTERBENCH_VERSION=\"${PROJECT_VERSION}\"")
  set(FOLDER ${CMAKE_CURRENT_BINARY_DIR}/facts)
  add_custom_target(clusterbench_git_sha
    COMMAND ${CMAKE_COMMAND} -DSOURCE=${CMAKE_CURRENT_SOURCE_DIR} -DOUTPUT=${FOLDER}/run/git_sha.h
            -P ${CMAKE_CURRENT_SOURCE_DIR}/cmake/WriteGitSha.cmake
    BYPRODUCTS ${FOLDER}/run/git_sha.h)
  add_dependencies(${TARGET} clusterbench_git_sha)
  target_include_directories(${TARGET} PRIVATE ${FOLDER})
endfunction()
