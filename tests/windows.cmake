# The tests of a build for Windows: those of the layers that ask the system for nothing, and of the layer os what every system has to
# do. The others are written for POSIX: they start shells, or look into /proc.
file(GENERATE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/places.cpp CONTENT "#include \"places.h\"

namespace clusterbench::test {

std::string source_dir() { return R\"__(${PROJECT_SOURCE_DIR})__\"; }
std::string program() { return R\"__($<TARGET_FILE:clusterbench>)__\"; }
std::string slowed_program() { return {}; }
std::string plugin_folder() { return {}; }

}  // namespace clusterbench::test
")
add_library(test_places STATIC ${CMAKE_CURRENT_BINARY_DIR}/places.cpp)
target_link_libraries(test_places PRIVATE clusterbench_flags)
target_include_directories(test_places PUBLIC ${CMAKE_CURRENT_SOURCE_DIR})

file(GLOB OS_TESTS CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/os/windows/*.cpp)
add_executable(test_os ${CMAKE_CURRENT_SOURCE_DIR}/os/everywhere_test.cpp ${OS_TESTS})
target_link_libraries(test_os PRIVATE cb_os GTest::gtest GTest::gtest_main)
add_test(NAME os COMMAND test_os)

add_compile_definitions(_USE_MATH_DEFINES) # M_PI
foreach(LAYER core result geom view grid cull assign layout measure)
  file(GLOB LAYER_TESTS CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${LAYER}/*.cpp)
  # Pipes and devices; scenes in folders that POSIX makes.
  list(FILTER LAYER_TESTS EXCLUDE REGEX "/(file_text|light_map|visible_sets)_test\\.cpp$")
  add_executable(test_${LAYER} ${LAYER_TESTS})
  target_compile_options(test_${LAYER} PRIVATE $<$<CONFIG:Release>:-Og>)
  clusterbench_unite(test_${LAYER})
  target_link_libraries(test_${LAYER} PRIVATE cb_${LAYER} test_places GTest::gtest GTest::gtest_main)
  add_test(NAME ${LAYER} COMMAND test_${LAYER})
endforeach()
