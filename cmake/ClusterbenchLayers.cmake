# clusterbench_layer(NAME [ONLY files...] [EXCEPT files...] [LINK libs...]): the static library src/NAME, which sees every layer
# declared before it.
# clusterbench_program(NAME [LINK libs...]): the same for src/NAME, with src/NAME/main.cpp as the `clusterbench` binary.

# Where sanitizers look at a few layers, as in .ci/run, the others can be those of another build: without sanitizers, quick to run
# and not built again. Their files are exchanged for its archive when all layers are declared (clusterbench_rest).
set(CLUSTERBENCH_REST_FROM "" CACHE PATH "A build without sanitizers, whose layers stand in for those that CLUSTERBENCH_SANITIZED_LAYERS does not name")
set(CLUSTERBENCH_SANITIZED_LAYERS "" CACHE STRING "With CLUSTERBENCH_REST_FROM: the layers that are built here")

add_library(clusterbench_flags INTERFACE)
target_compile_options(clusterbench_flags INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Woverloaded-virtual -Wcast-qual -Wvla
  -ffp-contract=off
  -fmacro-prefix-map=${PROJECT_SOURCE_DIR}/=  # __FILE__ is the same in every checkout, so that ccache serves all of them
  $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>  # g++ 12 sees overlaps in std::string's operator+ that are not there (PR 105651)
  # g++ 13 and 14 take a function with a reference and a temporary text among its arguments for one that returns the text.
  $<$<AND:$<CXX_COMPILER_ID:GNU>,$<VERSION_GREATER_EQUAL:$<CXX_COMPILER_VERSION>,13>>:-Wno-dangling-reference>
  $<$<BOOL:${CLUSTERBENCH_WERROR}>:-Werror>)
# g++ collects its garbage from 128 MB on, again and again where headers are large: without that it takes a sixth less time
# and a quarter more memory.
cmake_host_system_information(RESULT BUILD_MEMORY_MIB QUERY TOTAL_PHYSICAL_MEMORY)
cmake_host_system_information(RESULT BUILD_PROCESSORS QUERY NUMBER_OF_LOGICAL_CORES)
if(BUILD_PROCESSORS GREATER 0) # without /proc neither is known
  math(EXPR BUILD_MEMORY_MIB "${BUILD_MEMORY_MIB} / ${BUILD_PROCESSORS}")
endif()
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND BUILD_MEMORY_MIB GREATER 1500)
  target_compile_options(clusterbench_flags INTERFACE --param=ggc-min-heapsize=700000)
endif()
target_include_directories(clusterbench_flags INTERFACE ${CMAKE_CURRENT_SOURCE_DIR}/src)
target_link_libraries(clusterbench_flags INTERFACE Threads::Threads)
if(CLUSTERBENCH_LIBRARY_ONLY)
  target_compile_definitions(clusterbench_flags INTERFACE CLUSTERBENCH_OWN_VECTORS=1)
else()
  target_link_libraries(clusterbench_flags INTERFACE glm::glm)
  target_include_directories(clusterbench_flags SYSTEM INTERFACE ${BOOST_INCLUDE})
endif()
if(CLUSTERBENCH_SANITIZE)
  target_compile_options(clusterbench_flags INTERFACE
    -fsanitize=${CLUSTERBENCH_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  target_link_options(clusterbench_flags INTERFACE -fsanitize=${CLUSTERBENCH_SANITIZE})
  # The check of dynamic types opens a pipe for each type that is new to it. It fails in a test that allows no more open files.
  if(CLUSTERBENCH_REST_FROM)
    target_compile_options(clusterbench_flags INTERFACE -fno-sanitize=vptr)
  endif()
  # Two dozen programs of 100 MB and more are linked; lld takes a fraction of ld's time.
  find_program(LLD ld.lld)
  if(LLD AND CMAKE_CXX_COMPILER_ID MATCHES "Clang")
    target_link_options(clusterbench_flags INTERFACE -fuse-ld=lld)
  endif()
endif()

# clusterbench_unite(TARGET [COUNT]): its files are compiled COUNT at a time, or eight. Each of them brings headers whose
# code takes longer to build than its own. Not for layers whose time is measured: what is inlined there must not depend on the neighbours.
function(clusterbench_unite TARGET)
  if(CLUSTERBENCH_UNITY)
    set(COUNT 8)
    if(ARGC GREATER 1)
      set(COUNT ${ARGV1})
    endif()
    set_target_properties(${TARGET} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE ${COUNT})
  endif()
endfunction()

# With g++, layers of many small files parse these once for all of them: it saves a quarter of their time. Where files are
# united it saves little, and of sums of texts g++ 12 warns as if the library were our own (PR 105651); clang takes no headers
# that were parsed with other options (functions of assign are aligned). What a file needs it includes all the same:
# clang and scripts/check_style compile without.
set(CLUSTERBENCH_PRECOMPILED_LAYERS "")
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  set(CLUSTERBENCH_PRECOMPILED_LAYERS core geom view depth assign)
  if(CMAKE_SYSTEM_PROCESSOR MATCHES "^(aarch64|arm64)$")
    list(REMOVE_ITEM CLUSTERBENCH_PRECOMPILED_LAYERS assign) # it is built for another processor (CMakeLists.txt)
  endif()
  file(WRITE ${CMAKE_CURRENT_BINARY_DIR}/precompiled.cpp.new "")
  file(COPY_FILE ${CMAKE_CURRENT_BINARY_DIR}/precompiled.cpp.new ${CMAKE_CURRENT_BINARY_DIR}/precompiled.cpp ONLY_IF_DIFFERENT)
  add_library(clusterbench_precompiled OBJECT EXCLUDE_FROM_ALL ${CMAKE_CURRENT_BINARY_DIR}/precompiled.cpp)
  target_link_libraries(clusterbench_precompiled PRIVATE clusterbench_flags)
  target_compile_options(clusterbench_precompiled PRIVATE -fpch-preprocess)
  set(GLM_HEADERS "")
  if(NOT CLUSTERBENCH_LIBRARY_ONLY)
    set(GLM_HEADERS <glm/glm.hpp>)
  endif()
  target_precompile_headers(clusterbench_precompiled PRIVATE <algorithm> <array> <cmath> <cstdint> <functional> <limits> <map>
    <memory> <optional> <span> <string> <string_view> <utility> <variant> <vector> ${GLM_HEADERS})
endif()

set(CLUSTERBENCH_ABOVE "")

# Layers that leave the long work to others and whose code is not timed, but for the files of run that CMakeLists.txt names.
# With -Og they build in half the time that -O3 takes, and as fast as with -O0; reading and writing a result takes half as
# long again as with -O1 (0.7 MB: 0.1 s).
set(CLUSTERBENCH_UNTIMED_LAYERS os result layout gpu config dump run pictures stress acceptance search report cli)

# Layers that spend no time of their own. Sanitized code takes long to build where it is optimised, and longest where it
# is written for many vectors; so only the other layers are, a little.
set(CLUSTERBENCH_COLD_LAYERS os result layout gpu config dump run pictures stress acceptance search report cli)
set(CLUSTERBENCH_COLD_OPTIONS "")
if(CLUSTERBENCH_SANITIZE)
  list(APPEND CLUSTERBENCH_COLD_LAYERS scene)
  set(CLUSTERBENCH_COLD_OPTIONS -O0)
  # Long to optimise, and needed where no quicker proof decides.
  set_source_files_properties(${CMAKE_CURRENT_SOURCE_DIR}/src/geom/spot/shell_cell_proof.cpp
    ${CMAKE_CURRENT_SOURCE_DIR}/src/geom/spot/plane_cell_proof.cpp PROPERTIES COMPILE_OPTIONS -O0)
endif()

set(CLUSTERBENCH_UNITED_LAYERS scene measure)

set(CLUSTERBENCH_REST "")

macro(clusterbench_layer NAME)
  cmake_parse_arguments(LAYER "" "" "ONLY;EXCEPT;LINK" ${ARGN})
  file(GLOB_RECURSE LAYER_SOURCES CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/src/${NAME}/*.cpp)
  if(LAYER_ONLY)
    list(TRANSFORM LAYER_ONLY PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/src/${NAME}/ OUTPUT_VARIABLE LAYER_SOURCES)
  endif()
  list(TRANSFORM LAYER_EXCEPT PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/src/${NAME}/)
  list(REMOVE_ITEM LAYER_SOURCES ${LAYER_EXCEPT})
  list(FILTER LAYER_SOURCES EXCLUDE REGEX "/main\\.cpp$")
  add_library(cb_${NAME} STATIC ${LAYER_SOURCES})
  set_target_properties(cb_${NAME} PROPERTIES LINKER_LANGUAGE CXX)
  if(${NAME} IN_LIST CLUSTERBENCH_COLD_LAYERS)
    target_compile_options(cb_${NAME} PRIVATE ${CLUSTERBENCH_COLD_OPTIONS})
  endif()
  if(${NAME} IN_LIST CLUSTERBENCH_UNTIMED_LAYERS)
    target_compile_options(cb_${NAME} PRIVATE $<$<CONFIG:Release>:-Og>)
  endif()
  # Under sanitizers nothing is timed. The files of geom have the same names for the same shapes in other arithmetic.
  if(${NAME} IN_LIST CLUSTERBENCH_UNTIMED_LAYERS)
    clusterbench_unite(cb_${NAME} 16) # small files, whose templates of JSON and records are the same
  elseif(${NAME} IN_LIST CLUSTERBENCH_UNITED_LAYERS OR (CLUSTERBENCH_SANITIZE AND NOT ${NAME} STREQUAL geom))
    clusterbench_unite(cb_${NAME})
  elseif(${NAME} IN_LIST CLUSTERBENCH_PRECOMPILED_LAYERS)
    target_precompile_headers(cb_${NAME} REUSE_FROM clusterbench_precompiled)
    target_compile_options(cb_${NAME} PRIVATE -fpch-preprocess) # ccache asks for it
  endif()
  if(CLUSTERBENCH_REST_FROM AND NOT ${NAME} IN_LIST CLUSTERBENCH_SANITIZED_LAYERS)
    list(APPEND CLUSTERBENCH_REST ${NAME})
    add_library(rest_${NAME} STATIC IMPORTED)
    set_target_properties(rest_${NAME} PROPERTIES IMPORTED_LOCATION ${CLUSTERBENCH_REST_FROM}/libcb_${NAME}.a)
    target_link_libraries(rest_${NAME} INTERFACE clusterbench_flags ${CLUSTERBENCH_ABOVE} ${LAYER_LINK})
    target_link_libraries(cb_${NAME} PUBLIC rest_${NAME})
  endif()
  target_link_libraries(cb_${NAME} PUBLIC clusterbench_flags ${CLUSTERBENCH_ABOVE} ${LAYER_LINK})
  list(PREPEND CLUSTERBENCH_ABOVE cb_${NAME})
endmacro()

# clusterbench_rest(): leaves nothing to build of the layers that come from CLUSTERBENCH_REST_FROM.
function(clusterbench_rest)
  set(NOTHING ${CMAKE_CURRENT_BINARY_DIR}/nothing.cpp)
  file(CONFIGURE OUTPUT ${NOTHING} CONTENT "// of another build\n")
  foreach(NAME ${CLUSTERBENCH_REST})
    if(NOT EXISTS ${CLUSTERBENCH_REST_FROM}/libcb_${NAME}.a)
      message(FATAL_ERROR "CLUSTERBENCH_REST_FROM: ${CLUSTERBENCH_REST_FROM} has no libcb_${NAME}.a; build it first")
    endif()
    set_property(TARGET cb_${NAME} PROPERTY SOURCES ${NOTHING})
  endforeach()
endfunction()

macro(clusterbench_program NAME)
  clusterbench_layer(${NAME} ${ARGN})
  add_executable(clusterbench ${CMAKE_CURRENT_SOURCE_DIR}/src/${NAME}/main.cpp)
  target_link_libraries(clusterbench PRIVATE cb_${NAME})
  install(TARGETS clusterbench RUNTIME)
endmacro()
