# clusterbench_report_page(TARGET): bundles page/ into the pages that `clusterbench report`, `history show` and `check` fill in,
# and adds them to the target. Needs Node.js and npm, and brings page/node_modules up to its lock file. Where that cannot be,
# the build leaves the pages out, says so here, and the commands say what was missing.
function(clusterbench_report_page TARGET)
  set(PAGE ${CMAKE_CURRENT_SOURCE_DIR}/page)
  set(FOLDER ${CMAKE_CURRENT_BINARY_DIR}/page)
  set(EMBEDDED ${FOLDER}/page_template.cpp)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${PAGE}/package-lock.json ${PAGE}/.npmrc)
  if(CLUSTERBENCH_TRIES_NODE)
    clusterbench_report_modules(${PAGE} OBSTACLE)
  else()
    set(OBSTACLE "this clusterbench was built without Node.js, which bundles them")
  endif()
  set(CLUSTERBENCH_NO_PAGE "${OBSTACLE}" PARENT_SCOPE)
  set(HAS_PAGE TRUE)
  if(OBSTACLE)
    set(HAS_PAGE FALSE)
  endif()
  clusterbench_optional(NODE HAS_PAGE "Node.js and npm (${OBSTACLE})" "the pages of report, history show and check are left out")
  set(CLUSTERBENCH_HAS_NODE ${CLUSTERBENCH_HAS_NODE} PARENT_SCOPE)
  if(OBSTACLE)
    file(CONFIGURE OUTPUT ${EMBEDDED} CONTENT "#include \"report/page/page_template.h\"

namespace clusterbench::report {

std::string_view page_template() { return {}; }
std::string_view history_template() { return {}; }
std::string_view check_template() { return {}; }
std::string_view page_obstacle() { return R\"__(@OBSTACLE@)__\"; }

}  // namespace clusterbench::report
" @ONLY)
  else()
    file(GLOB_RECURSE SOURCES CONFIGURE_DEPENDS ${PAGE}/src/*.ts ${PAGE}/src/*.css ${PAGE}/src/*.html)
    add_custom_command(OUTPUT ${EMBEDDED} BYPRODUCTS ${FOLDER}/template.html ${FOLDER}/history.html ${FOLDER}/check.html
      COMMAND ${NODE} ${PAGE}/build.mjs ${FOLDER}
      DEPENDS ${SOURCES} ${PAGE}/build.mjs ${PAGE}/package-lock.json
      COMMENT "Bundling the pages")
    set_source_files_properties(${EMBEDDED} PROPERTIES COMPILE_OPTIONS -Wno-overlength-strings)
  endif()
  target_sources(${TARGET} PRIVATE ${EMBEDDED})
endfunction()

# Sets OBSTACLE to "" once page/node_modules is what the lock file says, else to what keeps it from being so.
function(clusterbench_report_modules PAGE OBSTACLE)
  find_program(NODE node)
  find_program(NPM npm)
  if(NOT NODE OR NOT NPM)
    set(${OBSTACLE} "this build was made without Node.js and npm: install them (scripts/setup does), then configure and build again" PARENT_SCOPE)
    return()
  endif()
  set(${OBSTACLE} "" PARENT_SCOPE)
  if(NOT ${PAGE}/package-lock.json IS_NEWER_THAN ${PAGE}/node_modules/.package-lock.json)
    return()
  endif()
  execute_process(COMMAND ${NPM} ci --no-progress WORKING_DIRECTORY ${PAGE}
                  RESULT_VARIABLE FAILED OUTPUT_VARIABLE SAID ERROR_VARIABLE SAID)
  if(FAILED)
    message(STATUS "npm ci: ${SAID}")
    set(${OBSTACLE} "`npm ci` in page/ failed when this build was configured: run it there to see why, then configure and build again" PARENT_SCOPE)
  endif()
endfunction()
