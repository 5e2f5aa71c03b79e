# The library that engines link: the layers down to assign without scenes, JSON, files and ray casting, and the façade src/library, in
# one archive. It needs Highway alone: its threads are those of the standard library, and where nothing else is built
# (CLUSTERBENCH_LIBRARY_ONLY) its vectors and exact numbers are our own. docs/embedding.md is its page.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

# Of these layers only these files; of geom, grid, assign and library all.
set(CLUSTERBENCH_LIBRARY_CORE error.cpp memory.cpp shared_threads.cpp text.cpp)
set(CLUSTERBENCH_LIBRARY_SCENE boxes.cpp)
set(CLUSTERBENCH_LIBRARY_VIEW frame.cpp)
set(CLUSTERBENCH_LIBRARY_DEPTH depth_image.cpp)

# clusterbench_library_layers(): the layers, where nothing else is built.
macro(clusterbench_library_layers)
  clusterbench_layer(core ONLY ${CLUSTERBENCH_LIBRARY_CORE})
  clusterbench_layer(geom)
  clusterbench_layer(scene ONLY ${CLUSTERBENCH_LIBRARY_SCENE})
  clusterbench_layer(view ONLY ${CLUSTERBENCH_LIBRARY_VIEW})
  clusterbench_layer(depth ONLY ${CLUSTERBENCH_LIBRARY_DEPTH})
  clusterbench_layer(grid EXCEPT grid_name.cpp)
  clusterbench_layer(assign LINK hwy::hwy)
  clusterbench_simd(cb_assign)
  clusterbench_layer(library)
endmacro()

# The objects of some files of a layer.
function(clusterbench_objects_of OUT LAYER)
  list(JOIN ARGN "|" NAMES)
  string(REPLACE "." "\\." NAMES "${NAMES}")
  set(${OUT} "$<FILTER:$<TARGET_OBJECTS:cb_${LAYER}>,INCLUDE,/(${NAMES})\\.o>" PARENT_SCOPE)
endfunction()

# clusterbench_library(): the targets clusterbench::assign and clusterbench::plugin, for the build and installed.
function(clusterbench_library)
  set_property(SOURCE ${PROJECT_SOURCE_DIR}/src/library/light_lists.cpp APPEND PROPERTY
    COMPILE_DEFINITIONS CLUSTERBENCH_LIBRARY_VERSION="${PROJECT_VERSION}")
  if(CLUSTERBENCH_SANITIZE)
    return() # an engine's own build has its own sanitizers
  endif()
  set_source_files_properties(${PROJECT_SOURCE_DIR}/src/scene/boxes.cpp PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
  clusterbench_objects_of(CORE core ${CLUSTERBENCH_LIBRARY_CORE})
  clusterbench_objects_of(SCENE scene ${CLUSTERBENCH_LIBRARY_SCENE})
  clusterbench_objects_of(VIEW view ${CLUSTERBENCH_LIBRARY_VIEW})
  clusterbench_objects_of(DEPTH depth ${CLUSTERBENCH_LIBRARY_DEPTH})
  add_library(cb_own_threads OBJECT ${PROJECT_SOURCE_DIR}/src/core/own_threads.cpp)
  target_link_libraries(cb_own_threads PRIVATE clusterbench_flags)
  add_library(clusterbench_assign STATIC ${CORE} ${SCENE} ${VIEW} ${DEPTH} $<TARGET_OBJECTS:cb_own_threads> $<TARGET_OBJECTS:cb_geom>
    $<FILTER:$<TARGET_OBJECTS:cb_grid>,EXCLUDE,/grid_name\\.cpp> $<TARGET_OBJECTS:cb_assign> $<TARGET_OBJECTS:cb_library>)
  set_target_properties(clusterbench_assign PROPERTIES EXPORT_NAME assign LINKER_LANGUAGE CXX)
  target_compile_features(clusterbench_assign INTERFACE cxx_std_20)
  target_link_libraries(clusterbench_assign PRIVATE hwy::hwy Threads::Threads)
  configure_file(${PROJECT_SOURCE_DIR}/src/library/assign.h ${CMAKE_CURRENT_BINARY_DIR}/include/clusterbench/assign.h COPYONLY)
  target_include_directories(clusterbench_assign INTERFACE
    $<BUILD_INTERFACE:${CMAKE_CURRENT_BINARY_DIR}/include> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  add_library(clusterbench::assign ALIAS clusterbench_assign)

  add_library(clusterbench_plugin INTERFACE)
  set_target_properties(clusterbench_plugin PROPERTIES EXPORT_NAME plugin)
  target_include_directories(clusterbench_plugin INTERFACE
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/src/plugin> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  add_library(clusterbench::plugin ALIAS clusterbench_plugin)
  clusterbench_install_library()
endfunction()

function(clusterbench_install_library)
  set(CONFIG_FOLDER ${CMAKE_INSTALL_LIBDIR}/cmake/clusterbench)
  file(GLOB PLUGIN_HEADERS CONFIGURE_DEPENDS
    ${PROJECT_SOURCE_DIR}/src/plugin/clusterbench_plugin.h ${PROJECT_SOURCE_DIR}/src/plugin/clusterbench_plugin.hpp)
  install(TARGETS clusterbench_assign clusterbench_plugin EXPORT clusterbench
    ARCHIVE COMPONENT library INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
  install(FILES ${PROJECT_SOURCE_DIR}/src/library/assign.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/clusterbench COMPONENT library)
  install(FILES ${PLUGIN_HEADERS} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT library)
  install(EXPORT clusterbench FILE clusterbenchTargets.cmake NAMESPACE clusterbench:: DESTINATION ${CONFIG_FOLDER} COMPONENT library)
  configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/clusterbenchConfig.cmake.in
    ${CMAKE_CURRENT_BINARY_DIR}/install/clusterbenchConfig.cmake INSTALL_DESTINATION ${CONFIG_FOLDER})
  write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/install/clusterbenchConfigVersion.cmake
    COMPATIBILITY SameMinorVersion) # before 1.0 a minor version may change the header
  install(FILES ${CMAKE_CURRENT_BINARY_DIR}/install/clusterbenchConfig.cmake
    ${CMAKE_CURRENT_BINARY_DIR}/install/clusterbenchConfigVersion.cmake DESTINATION ${CONFIG_FOLDER} COMPONENT library)
  # Found from the file's own place, so that an installed tree may be moved.
  file(RELATIVE_PATH PREFIX_FROM_FILE /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
  foreach(PART assign plugin)
    configure_file(${PROJECT_SOURCE_DIR}/cmake/clusterbench-${PART}.pc.in
      ${CMAKE_CURRENT_BINARY_DIR}/install/clusterbench-${PART}.pc @ONLY)
    install(FILES ${CMAKE_CURRENT_BINARY_DIR}/install/clusterbench-${PART}.pc
      DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT library)
  endforeach()
endfunction()
