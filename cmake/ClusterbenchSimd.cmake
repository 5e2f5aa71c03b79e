# clusterbench_simd(TARGET): how the code of src/assign is compiled, which is timed and written for several instruction sets.
function(clusterbench_simd TARGET)
  # Vectors of unknown length cannot be members of a class; NEON serves these machines, too. x86 without SSE4 is scalar.
  set(UNUSED_SIMD_TARGETS "HWY_SSSE3|HWY_SVE|HWY_SVE2|HWY_SVE_256|HWY_SVE2_128|HWY_RVV")
  # Under sanitizers these files take long to build: the machine's best target and the scalar one are enough (the tests of
  # other builds hold all targets to the same lists), and of checks of every pointer those of addresses. Optimising them takes
  # ten times as long, more than it saves.
  if(CLUSTERBENCH_SANITIZE)
    string(APPEND UNUSED_SIMD_TARGETS "|HWY_SSE4")
    if(EXISTS /proc/cpuinfo)
      file(STRINGS /proc/cpuinfo WITH_AVX512 REGEX "avx512vl" LIMIT_COUNT 1)
    endif()
    if(WITH_AVX512)
      string(APPEND UNUSED_SIMD_TARGETS "|HWY_AVX2")
    endif()
    file(GLOB_RECURSE SIMD_SOURCES CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/assign/*.cpp)
    foreach(SOURCE ${SIMD_SOURCES})
      file(STRINGS ${SOURCE} FOR_TARGETS REGEX "foreach_target.h" LIMIT_COUNT 1)
      if(NOT FOR_TARGETS)
        list(REMOVE_ITEM SIMD_SOURCES ${SOURCE})
      endif()
    endforeach()
    set_source_files_properties(${SIMD_SOURCES} PROPERTIES COMPILE_OPTIONS
      "-O0;-fno-sanitize=null,alignment,object-size,pointer-overflow,vptr" SKIP_UNITY_BUILD_INCLUSION ON)
  endif()
  # Where a function lands within a line of the cache decides some percent of a method's time. So that a change elsewhere in
  # the layer decides none of it, each begins a line.
  target_compile_options(${TARGET} PRIVATE -falign-functions=64)
  target_compile_definitions(${TARGET} PRIVATE "HWY_DISABLED_TARGETS=(${UNUSED_SIMD_TARGETS})")
  # NEON is all that there is on these machines. g++ gives constructors that it makes itself none of what Highway asks for
  # its functions, so that vectors could not be members of a class.
  if(CMAKE_SYSTEM_PROCESSOR MATCHES "^(aarch64|arm64)$" AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    target_compile_options(${TARGET} PRIVATE -march=armv8-a+crypto)
  endif()
endfunction()
