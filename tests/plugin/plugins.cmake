# The plug-ins that tests load, as somebody else builds them: the headers of src/plugin alone, and no flag of the program's.
enable_language(C)
set(PLUGIN_FOLDER ${CMAKE_CURRENT_BINARY_DIR}/plugins)
set(TEST_PLUGINS "")

# clusterbench_test_plugin(NAME SOURCE [DEFINITION...]): PLUGIN_FOLDER/NAME.so.
function(clusterbench_test_plugin NAME SOURCE)
  add_library(plugin_${NAME} MODULE ${CMAKE_CURRENT_SOURCE_DIR}/plugin/${SOURCE})
  set_target_properties(plugin_${NAME} PROPERTIES PREFIX "" SUFFIX ".so" OUTPUT_NAME ${NAME} LIBRARY_OUTPUT_DIRECTORY ${PLUGIN_FOLDER}
    CXX_STANDARD 17 C_STANDARD 99 C_EXTENSIONS OFF CXX_VISIBILITY_PRESET hidden C_VISIBILITY_PRESET hidden)
  target_include_directories(plugin_${NAME} PRIVATE ${PROJECT_SOURCE_DIR}/src/plugin)
  target_compile_definitions(plugin_${NAME} PRIVATE ${ARGN})
  target_compile_options(plugin_${NAME} PRIVATE -Wall -Wextra -Wpedantic -Wshadow $<$<BOOL:${CLUSTERBENCH_WERROR}>:-Werror>)
  list(APPEND TEST_PLUGINS plugin_${NAME})
  set(TEST_PLUGINS ${TEST_PLUGINS} PARENT_SCOPE)
endfunction()

clusterbench_test_plugin(example examples/cell_boxes.cpp)
clusterbench_test_plugin(in-c examples/cell_boxes_in_c.c)
clusterbench_test_plugin(hostile hostile/hostile.cpp)
clusterbench_test_plugin(takes-all hostile/takes_all.c)
clusterbench_test_plugin(ends-thread hostile/takes_all.c ENDS_THREAD)
clusterbench_test_plugin(version-2 hostile/entry.c ENTRY_VERSION_2)
clusterbench_test_plugin(entry-crashes hostile/entry.c ENTRY_CRASHES)
clusterbench_test_plugin(entry-ends-thread hostile/entry.c ENTRY_ENDS_THREAD)
clusterbench_test_plugin(entry-null hostile/entry.c ENTRY_NULL)
clusterbench_test_plugin(entry-hangs hostile/entry.c ENTRY_HANGS)
clusterbench_test_plugin(no-entry hostile/entry.c)
clusterbench_test_plugin(translating hostile/translating.cpp)
clusterbench_test_plugin(bare hostile/bare.cpp)
clusterbench_test_plugin(entry-throws hostile/bare.cpp ENTRY_THROWS)
clusterbench_test_plugin(create-throws hostile/bare.cpp CREATE_THROWS)
clusterbench_test_plugin(destroy-throws hostile/bare.cpp DESTROY_THROWS)

# The interface as a C compiler sees it, for test_plugin.
add_library(plugin_interface_in_c STATIC ${CMAKE_CURRENT_SOURCE_DIR}/plugin/interface_in_c.c)
set_target_properties(plugin_interface_in_c PROPERTIES C_STANDARD 99 C_EXTENSIONS OFF)
target_include_directories(plugin_interface_in_c PRIVATE ${PROJECT_SOURCE_DIR}/src ${CMAKE_CURRENT_SOURCE_DIR})
target_compile_options(plugin_interface_in_c PRIVATE -Wall -Wextra -Wpedantic -Wshadow $<$<BOOL:${CLUSTERBENCH_WERROR}>:-Werror>)

# The method that CONTRIBUTING.md writes out, which test_plugin runs both ways.
set(CONTRIBUTING_EXAMPLE ${CMAKE_CURRENT_BINARY_DIR}/contributing_example.cpp)
find_package(Python3 REQUIRED COMPONENTS Interpreter)
add_custom_command(OUTPUT ${CONTRIBUTING_EXAMPLE}
  COMMAND ${Python3_EXECUTABLE} ${CMAKE_CURRENT_SOURCE_DIR}/test_contributing_example.py --write ${CONTRIBUTING_EXAMPLE}
  DEPENDS ${PROJECT_SOURCE_DIR}/CONTRIBUTING.md ${CMAKE_CURRENT_SOURCE_DIR}/test_contributing_example.py VERBATIM)

# And as a plug-in, with those files of the program that it needs; what these need and it does not call is left out.
file(GLOB EXAMPLE_NEEDS CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/src/grid/*.cpp ${PROJECT_SOURCE_DIR}/src/view/frame.cpp
  ${PROJECT_SOURCE_DIR}/src/core/error.cpp ${PROJECT_SOURCE_DIR}/src/core/memory.cpp ${PROJECT_SOURCE_DIR}/src/core/text.cpp
  ${PROJECT_SOURCE_DIR}/src/depth/depth_image.cpp ${PROJECT_SOURCE_DIR}/src/geom/*/bounding_volumes.cpp
  ${PROJECT_SOURCE_DIR}/src/geom/*/disk_tangents.cpp ${PROJECT_SOURCE_DIR}/src/geom/*/touch_tests.cpp
  ${PROJECT_SOURCE_DIR}/src/assign/bounds/cell_bounds.cpp ${PROJECT_SOURCE_DIR}/src/assign/contract/light_test.cpp
  ${PROJECT_SOURCE_DIR}/src/assign/contract/lists.cpp ${PROJECT_SOURCE_DIR}/src/assign/contract/params.cpp
  ${PROJECT_SOURCE_DIR}/src/plugin/exported_method.cpp ${PROJECT_SOURCE_DIR}/src/plugin/views.cpp)
add_library(plugin_contributing MODULE ${CONTRIBUTING_EXAMPLE} ${CMAKE_CURRENT_SOURCE_DIR}/plugin/examples/contributing_plugin.cpp
  ${EXAMPLE_NEEDS})
set_target_properties(plugin_contributing PROPERTIES PREFIX "" SUFFIX ".so" OUTPUT_NAME contributing
  LIBRARY_OUTPUT_DIRECTORY ${PLUGIN_FOLDER} CXX_VISIBILITY_PRESET hidden)
target_compile_options(plugin_contributing PRIVATE -ffp-contract=off -ffunction-sections -fdata-sections ${CLUSTERBENCH_COLD_OPTIONS})
target_include_directories(plugin_contributing PRIVATE ${PROJECT_SOURCE_DIR}/src)
target_link_libraries(plugin_contributing PRIVATE glm::glm)
target_link_options(plugin_contributing PRIVATE -Wl,--gc-sections -Wl,--no-undefined)
list(APPEND TEST_PLUGINS plugin_contributing)
