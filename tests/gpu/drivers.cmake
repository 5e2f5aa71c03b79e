# The tests of the layer gpu. Those that need no device are called gpu.SUITE.NAME; those on a device (suites Device*) run once in
# each of these modes, as gpu.MODE.SUITE.NAME, and so do some of the layer run:
#   lavapipe, swiftshader       on the two software drivers
#   lavapipe_reversed           with the invocations of each group numbered from the other end (lane_index() of common.glsl)
#   lavapipe_sync               the validation layer looks for missing barriers between commands
#   lavapipe_bounds             it looks for reads and writes beyond buffers
#   lavapipe_core               it looks for what is used against the rules, or not destroyed
# A missing driver, layer or Vulkan itself skips them with the reason; .ci/run takes that for a failure.

# Faults of Vulkan's calls, which the test program puts between the layer and the driver.
if(VULKAN_INCLUDE AND VOLK_INCLUDE AND GLSLANG)
  set(FAULTS gpu/faults/made_and_destroyed.cpp gpu/faults/faults_test.cpp)
  target_sources(test_gpu PRIVATE ${FAULTS})
  target_include_directories(test_gpu SYSTEM PRIVATE ${VULKAN_INCLUDE} ${VOLK_INCLUDE})
  set_source_files_properties(${FAULTS} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
endif()

# The test program takes shaders of a folder in place of the embedded ones where it is told so: those with other numbers of
# invocations, and changed ones of scripts/shader_mutations.py.
if(NOT CLUSTERBENCH_SANITIZE AND GLSLANG AND VULKAN_INCLUDE AND VOLK_INCLUDE)
  target_sources(test_gpu PRIVATE gpu/swapped/swapped_shaders.cpp)
  set_source_files_properties(gpu/swapped/swapped_shaders.cpp PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
  target_link_options(test_gpu PRIVATE
    -Wl,--wrap=_ZN12clusterbench3gpu11shader_codeESt17basic_string_viewIcSt11char_traitsIcEEb)
  set(REVERSED ${CMAKE_CURRENT_BINARY_DIR}/reversed_shaders)
  file(MAKE_DIRECTORY ${REVERSED})
  file(GLOB SHADERS CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/gpu/shaders/*.comp)
  file(GLOB INCLUDED CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/gpu/shaders/*.glsl)
  set(MODULES "")
  foreach(SHADER ${SHADERS})
    get_filename_component(NAME ${SHADER} NAME_WE)
    set(plain "")
    set(to_nearest -DROUNDS_TO_NEAREST)
    foreach(VARIANT plain to_nearest)
      add_custom_command(OUTPUT ${REVERSED}/${NAME}_${VARIANT}.spv VERBATIM
        DEPENDS ${SHADER} ${INCLUDED}
        COMMAND ${GLSLANG} -V --quiet --target-env vulkan1.2 -DREVERSED_LANES ${${VARIANT}}
                -o ${REVERSED}/${NAME}_${VARIANT}.spv ${SHADER})
      list(APPEND MODULES ${REVERSED}/${NAME}_${VARIANT}.spv)
    endforeach()
  endforeach()
  add_custom_target(reversed_shaders DEPENDS ${MODULES})
  add_dependencies(test_gpu reversed_shaders)
endif()

# Suites of ${PROGRAM} whose tests fit FILTER, in MODE and an environment; DRIVER is a file of the driver, or none.
set(PROGRAM test_gpu)
function(clusterbench_add_device_tests MODE DRIVER PACKAGE FILTER)
  if(NOT TARGET ${PROGRAM})
    return()
  endif()
  if(NOT DRIVER)
    if(NOT PROGRAM STREQUAL test_gpu)
      return() # that it lacks is said once
    endif()
    add_test(NAME gpu.${MODE} COMMAND ${CMAKE_COMMAND} -E echo "skipped: this machine lacks its driver (Debian: ${PACKAGE})")
    set_tests_properties(gpu.${MODE} PROPERTIES SKIP_REGULAR_EXPRESSION "skipped: ")
    return()
  endif()
  list(GET DRIVER 0 DRIVER)
  # Two threads find races between groups; more take turns with the other tests.
  set(ENVIRONMENT VK_DRIVER_FILES=${DRIVER} VK_ICD_FILENAMES=${DRIVER} LP_NUM_THREADS=2 ${ARGN})
  if(CLUSTERBENCH_SANITIZE)
    foreach(INDEX RANGE 1 2)
      math(EXPR SHARD "${INDEX} - 1")
      add_test(NAME gpu.${MODE}_${PROGRAM}_${INDEX} COMMAND ${PROGRAM} --gtest_filter=${FILTER})
      set_tests_properties(gpu.${MODE}_${PROGRAM}_${INDEX} PROPERTIES TIMEOUT 1200
        ENVIRONMENT "${ENVIRONMENT};GTEST_TOTAL_SHARDS=2;GTEST_SHARD_INDEX=${SHARD}")
    endforeach()
    return()
  endif()
  gtest_discover_tests(${PROGRAM} NO_PRETTY_VALUES TEST_PREFIX gpu.${MODE}. TEST_FILTER ${FILTER} TEST_LIST ${PROGRAM}_${MODE}
    DISCOVERY_TIMEOUT 60 PROPERTIES TIMEOUT 600)
  # Properties that are lists get lost on their way through gtest_discover_tests().
  file(WRITE ${CMAKE_CURRENT_BINARY_DIR}/${PROGRAM}_${MODE}.cmake "foreach(TEST IN LISTS ${PROGRAM}_${MODE})
  set_tests_properties(\${TEST} PROPERTIES ENVIRONMENT \"${ENVIRONMENT}\")
endforeach()
")
  set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES ${CMAKE_CURRENT_BINARY_DIR}/${PROGRAM}_${MODE}.cmake)
endfunction()

# Without a device, and without any driver.
set(NO_DRIVER VK_DRIVER_FILES=no-such-driver.json VK_ICD_FILENAMES=no-such-driver.json)
if(CLUSTERBENCH_SANITIZE)
  add_test(NAME gpu.part_1 COMMAND test_gpu --gtest_filter=-Device*:NoDriver*)
else()
  gtest_discover_tests(test_gpu NO_PRETTY_VALUES TEST_PREFIX gpu. TEST_FILTER -Device*:NoDriver* DISCOVERY_TIMEOUT 60
    PROPERTIES TIMEOUT 600)
endif()
add_test(NAME gpu.no_driver COMMAND test_gpu --gtest_filter=NoDriver*)
set_tests_properties(gpu.no_driver PROPERTIES ENVIRONMENT "${NO_DRIVER}" TIMEOUT 600 SKIP_REGULAR_EXPRESSION "skipped: ")

# lavapipe leaks at its end; SwiftShader's threads change stacks, which the thread sanitizer does not follow.
if(NOT CLUSTERBENCH_SANITIZE)
  clusterbench_add_device_tests(lavapipe "${LAVAPIPE}" mesa-vulkan-drivers Device*)
  clusterbench_add_device_tests(lavapipe_reversed "${LAVAPIPE}" mesa-vulkan-drivers
    "DeviceCommands.s*:DeviceMethods.have*:DeviceSizes.of_any*:DeviceOwnLists.*:DeviceOccupiedTiles.*:DeviceRefined.*:DeviceCells.*" CLUSTERBENCH_SWAPPED_SHADERS=${REVERSED})
  clusterbench_add_device_tests(lavapipe_sync "${LAVAPIPE}" mesa-vulkan-drivers
    "DeviceCommands.*:DeviceMethods.keep*:DeviceSizes.of_lists*:DeviceOwnLists.*:DeviceOccupiedTiles.*:DeviceRefined.lists_of*:DeviceCells.*:DeviceUserShaders.*:DeviceReading*-*find_the_lights_of_every*" CLUSTERBENCH_VULKAN_VALIDATION=sync)
  clusterbench_add_device_tests(lavapipe_bounds "${LAVAPIPE}" mesa-vulkan-drivers
    "DeviceCommands.*:DeviceSizes.of_any*:DeviceSizes.of_lists*:DeviceSizes.of_more*:DeviceOwnLists.of_tiles_know*:\
DeviceOwnLists.of_fixed_length_f*:DeviceOccupiedTiles.are*:DeviceRefined.lists_of*:DeviceUserShaders.leave*:DeviceReadingLookups.*:DeviceReadingWalks.differ*" CLUSTERBENCH_VULKAN_VALIDATION=gpu)
  clusterbench_add_device_tests(lavapipe_core "${LAVAPIPE}" mesa-vulkan-drivers "DeviceFaults.*"
    CLUSTERBENCH_VULKAN_VALIDATION=core)
endif()
if(NOT CLUSTERBENCH_SANITIZE STREQUAL "thread")
  # Not what takes it long, and not what wants rounding to nearest.
  clusterbench_add_device_tests(swiftshader "${SWIFTSHADER}" chromium
    "Device*-*million*:DeviceFaults.while_a_method*:DeviceReadingWalks.find_no*:DeviceReadingWalks.*8_bits:DeviceOwnLists.of_tiles_are_those_of_the_same*:DeviceOccupiedTiles.may*")
endif()
set(PROGRAM test_run)
if(NOT CLUSTERBENCH_SANITIZE)
  clusterbench_add_device_tests(lavapipe "${LAVAPIPE}" mesa-vulkan-drivers DevicePresets.*)
  clusterbench_add_device_tests(lavapipe_sync "${LAVAPIPE}" mesa-vulkan-drivers DevicePresets.are* CLUSTERBENCH_VULKAN_VALIDATION=sync)
  clusterbench_add_device_tests(swiftshader "${SWIFTSHADER}" chromium DevicePresets.*)
endif()

# Against the exact truth: some of the hard cases, and random settings. By hand, all: clusterbench stress --methods ^gpu-
if(NOT CLUSTERBENCH_SANITIZE)
  foreach(MODE lavapipe swiftshader)
    string(TOUPPER ${MODE} DRIVER)
    if(${DRIVER} AND TARGET reversed_shaders)
      list(GET ${DRIVER} 0 DRIVER)
      add_test(NAME gpu.${MODE}_stress COMMAND clusterbench stress --methods ^gpu-[a-z]+$ --cases H5|H7|H9|H19|H32 --random 60 -q
               -o ${PROJECT_BINARY_DIR}/stress_${MODE}.json)
      set_tests_properties(gpu.${MODE}_stress PROPERTIES ENVIRONMENT "VK_DRIVER_FILES=${DRIVER};VK_ICD_FILENAMES=${DRIVER}"
        TIMEOUT 600)
    endif()
  endforeach()
endif()

# What samples pay, through the program. SwiftShader, which compiles a pipeline for seconds, reads; it runs what does not
# depend on the driver no second time.
if(NOT CLUSTERBENCH_SANITIZE)
  set(swiftshader_only Readings)
  foreach(MODE lavapipe swiftshader)
    string(TOUPPER ${MODE} DRIVER)
    if(${DRIVER})
      list(GET ${DRIVER} 0 DRIVER)
      add_test(NAME gpu.${MODE}_readings COMMAND ${Python3_EXECUTABLE} ${CMAKE_CURRENT_SOURCE_DIR}/gpu/test_readings.py
               $<TARGET_FILE:clusterbench> ${PROJECT_SOURCE_DIR}/scenes ${${MODE}_only})
      set_tests_properties(gpu.${MODE}_readings PROPERTIES ENVIRONMENT "VK_DRIVER_FILES=${DRIVER};VK_ICD_FILENAMES=${DRIVER}"
        TIMEOUT 600 SKIP_RETURN_CODE 77)
    endif()
  endforeach()
endif()

# Shaders of users, through the program.
if(NOT CLUSTERBENCH_SANITIZE)
  foreach(MODE lavapipe swiftshader)
    string(TOUPPER ${MODE} DRIVER)
    if(${DRIVER})
      list(GET ${DRIVER} 0 DRIVER)
      foreach(SHADER_TEST user_shaders shader_faults)
        add_test(NAME gpu.${MODE}_${SHADER_TEST} COMMAND ${Python3_EXECUTABLE}
                 ${CMAKE_CURRENT_SOURCE_DIR}/gpu/test_${SHADER_TEST}.py $<TARGET_FILE:clusterbench> ${PROJECT_SOURCE_DIR})
        set_tests_properties(gpu.${MODE}_${SHADER_TEST} PROPERTIES
          ENVIRONMENT "VK_DRIVER_FILES=${DRIVER};VK_ICD_FILENAMES=${DRIVER};LP_NUM_THREADS=2" TIMEOUT 600 SKIP_RETURN_CODE 77)
      endforeach()
    endif()
  endforeach()
endif()

# The SPIR-V that the build embeds.
if(NOT CLUSTERBENCH_SANITIZE)
  add_test(NAME gpu.shaders
           COMMAND ${Python3_EXECUTABLE} ${CMAKE_CURRENT_SOURCE_DIR}/gpu/test_shaders.py ${PROJECT_BINARY_DIR}/spirv)
  set_tests_properties(gpu.shaders PROPERTIES SKIP_RETURN_CODE 77)
endif()
