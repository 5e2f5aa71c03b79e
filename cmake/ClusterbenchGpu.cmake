# clusterbench_gpu(TARGET): what the layer gpu needs of Vulkan: its headers, volk, and the shaders of src/gpu/shaders as SPIR-V,
# each once as it is and once asking for rounding to nearest. Where something is missing the layer says so at run time.
set(VULKAN_MISSING "")
if(CLUSTERBENCH_TRIES_VULKAN)
  find_path(VULKAN_INCLUDE vulkan/vulkan_core.h)
  find_path(VOLK_INCLUDE volk.h)
  find_program(GLSLANG glslangValidator)
  if(NOT VULKAN_INCLUDE)
    list(APPEND VULKAN_MISSING "the headers of Vulkan (Debian: libvulkan-dev)")
  endif()
  if(NOT VOLK_INCLUDE)
    list(APPEND VULKAN_MISSING "volk (Debian: libvulkan-volk-dev)")
  endif()
  if(NOT GLSLANG)
    list(APPEND VULKAN_MISSING "glslangValidator (Debian: glslang-tools)")
  endif()
else()
  set(VULKAN_MISSING "Vulkan")
endif()
list(JOIN VULKAN_MISSING ", " VULKAN_MISSING)
set(VULKAN_FOUND FALSE)
if(NOT VULKAN_MISSING)
  set(VULKAN_FOUND TRUE)
endif()
clusterbench_optional(VULKAN VULKAN_FOUND "${VULKAN_MISSING}" "methods on the GPU will not run")
# Checks the modules of users; without it only their structure is read.
if(CLUSTERBENCH_TRIES_SPIRV_TOOLS)
  find_path(SPIRV_TOOLS_INCLUDE spirv-tools/libspirv.hpp)
  find_library(SPIRV_TOOLS SPIRV-Tools)
  if(SPIRV_TOOLS_INCLUDE AND SPIRV_TOOLS)
    set(SPIRV_TOOLS_FOUND TRUE)
  endif()
endif()
clusterbench_optional(SPIRV_TOOLS SPIRV_TOOLS_FOUND "SPIRV-Tools (Debian: spirv-tools)"
  "shaders of users will not be held against all rules of SPIR-V")

function(clusterbench_gpu TARGET)
  set(FOLDER ${CMAKE_CURRENT_SOURCE_DIR}/src/gpu)
  get_target_property(SOURCES ${TARGET} SOURCES)
  if(CLUSTERBENCH_HAS_SPIRV_TOOLS)
    target_compile_definitions(${TARGET} PRIVATE CLUSTERBENCH_WITH_SPIRV_TOOLS=1)
    target_include_directories(${TARGET} SYSTEM PRIVATE ${SPIRV_TOOLS_INCLUDE})
    target_link_libraries(${TARGET} PRIVATE ${SPIRV_TOOLS})
  endif()
  if(NOT CLUSTERBENCH_HAS_VULKAN)
    list(FILTER SOURCES EXCLUDE REGEX "/gpu/vulkan/")
    set_target_properties(${TARGET} PROPERTIES SOURCES "${SOURCES}")
    target_compile_definitions(${TARGET} PRIVATE
      "CLUSTERBENCH_GPU_OBSTACLE=\"this clusterbench was built without ${VULKAN_MISSING}\"")
    return()
  endif()
  list(FILTER SOURCES EXCLUDE REGEX "/no_vulkan\\.cpp$")
  set_target_properties(${TARGET} PROPERTIES SOURCES "${SOURCES}")
  target_include_directories(${TARGET} SYSTEM PRIVATE ${VULKAN_INCLUDE} ${VOLK_INCLUDE})
  target_link_libraries(${TARGET} PRIVATE ${CMAKE_DL_LIBS})
  # volk is one file of C, which declares what Vulkan may ever have.
  set_source_files_properties(${FOLDER}/vulkan/instance.cpp PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)

  set(OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/spirv)
  file(MAKE_DIRECTORY ${OUTPUT})
  file(GLOB SHADERS CONFIGURE_DEPENDS ${FOLDER}/shaders/*.comp)
  file(GLOB INCLUDED CONFIGURE_DEPENDS ${FOLDER}/shaders/*.glsl)
  set(CODE "")
  set(CASES "")
  foreach(SHADER ${SHADERS})
    get_filename_component(NAME ${SHADER} NAME_WE)
    foreach(VARIANT plain to_nearest)
      set(DEFINE "")
      set(ASKS false)
      if(VARIANT STREQUAL to_nearest)
        set(DEFINE -DROUNDS_TO_NEAREST)
        set(ASKS true)
      endif()
      set(FILE ${OUTPUT}/${NAME}_${VARIANT}.h)
      add_custom_command(OUTPUT ${FILE} DEPENDS ${SHADER} ${INCLUDED} VERBATIM COMMENT "SPIR-V of ${NAME} (${VARIANT})"
        COMMAND ${GLSLANG} -V --quiet --target-env vulkan1.2 ${DEFINE} --vn ${NAME}_${VARIANT} -o ${FILE} ${SHADER})
      target_sources(${TARGET} PRIVATE ${FILE})
      string(APPEND CODE "#include \"spirv/${NAME}_${VARIANT}.h\"\n")
      string(APPEND CASES "  if (shader == \"${NAME}\" && rounds_to_nearest == ${ASKS}) return ${NAME}_${VARIANT};\n")
    endforeach()
  endforeach()
  target_include_directories(${TARGET} PRIVATE ${CMAKE_CURRENT_BINARY_DIR})
  clusterbench_embed_source(${TARGET} shader_code.cpp "#include \"gpu/vulkan/shader_code.h\"

#include \"core/error.h\"

namespace {
${CODE}}  // namespace

namespace clusterbench::gpu {

std::span<const std::uint32_t> shader_code(std::string_view shader, bool rounds_to_nearest) {
${CASES}  throw Error(\"\", \"device\", \"there is no shader \" + std::string(shader), ExitCode::internal);
}

}  // namespace clusterbench::gpu
")
  # A test program of its own links other shaders in its place.
  set_source_files_properties(${CMAKE_CURRENT_BINARY_DIR}/embedded/shader_code.cpp PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
endfunction()
