# clusterbench_package(): what `cpack` makes of a build. Generator External: an archive that needs glibc and libstdc++ alone.
# Generator DEB: the packages clusterbench and clusterbench-dev, with dependencies. scripts/package calls it in a way that
# gives the same bytes for the same commit and the same Debian packages. packaging/README.md says who adds what.
set(CLUSTERBENCH_MAINTAINER "The clusterbench maintainers <clusterbench@localhost.localdomain>" CACHE STRING
  "Who made the Debian packages: NAME <ADDRESS>")

# linux-x86_64, linux-aarch64, windows-x86_64
function(clusterbench_platform OUT)
  string(TOLOWER "${CMAKE_SYSTEM_NAME}-${CMAKE_SYSTEM_PROCESSOR}" PLATFORM)
  string(REPLACE "amd64" "x86_64" PLATFORM "${PLATFORM}")
  set(${OUT} ${PLATFORM} PARENT_SCOPE)
endfunction()

# The file that packaging/facts.py reads.
function(clusterbench_package_facts PLATFORM FILE)
  set(SYSROOT ${CLUSTERBENCH_SYSROOT})
  if(NOT SYSROOT)
    set(SYSROOT /)
  endif()
  set(BUILT "") # libraries that were built from the source of a Debian package
  if(CLUSTERBENCH_WINDOWS_ROOT)
    set(BUILT "\"${CLUSTERBENCH_WINDOWS_ROOT}/lib/libhwy.a\": \"libhwy-dev\", \"${CLUSTERBENCH_WINDOWS_ROOT}/include/hwy/\": \"libhwy-dev\"")
  endif()
  file(CONFIGURE OUTPUT ${FILE} CONTENT [[{
  "version": "@PROJECT_VERSION@", "platform": "@PLATFORM@", "triplet": "@CMAKE_LIBRARY_ARCHITECTURE@",
  "source": "@PROJECT_SOURCE_DIR@", "build": "@CMAKE_CURRENT_BINARY_DIR@", "sysroot": "@SYSROOT@",
  "dpkg": "@CLUSTERBENCH_SYSROOT_DPKG@", "readelf": "@CMAKE_READELF@",
  "maintainer": "@CLUSTERBENCH_MAINTAINER@", "program": "clusterbench@CMAKE_EXECUTABLE_SUFFIX@", "built": {@BUILT@}
}
]] @ONLY)
endfunction()

function(clusterbench_package)
  clusterbench_platform(PLATFORM)
  set(FACTS ${CMAKE_CURRENT_BINARY_DIR}/package_facts.json)
  clusterbench_package_facts(${PLATFORM} ${FACTS})
  find_program(CLUSTERBENCH_PYTHON python3)
  set(CPACK_CLUSTERBENCH_PYTHON ${CLUSTERBENCH_PYTHON})
  set(CPACK_CLUSTERBENCH_SOURCE ${PROJECT_SOURCE_DIR})
  set(CPACK_CLUSTERBENCH_FACTS ${FACTS})
  set(CPACK_PRE_BUILD_SCRIPTS ${PROJECT_SOURCE_DIR}/cmake/package/Stage.cmake)
  set(CPACK_PROJECT_CONFIG_FILE ${PROJECT_SOURCE_DIR}/cmake/package/Generator.cmake)

  set(CPACK_GENERATOR External)
  set(CPACK_CLUSTERBENCH_ENDING .tar.xz)
  if(WIN32)
    set(CPACK_CLUSTERBENCH_ENDING .zip)
  endif()
  set(CPACK_PACKAGE_NAME clusterbench)
  set(CPACK_PACKAGE_VENDOR clusterbench)
  set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
  set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "measures clustered light assignment")
  set(CPACK_PACKAGE_FILE_NAME clusterbench-${PROJECT_VERSION}-${PLATFORM})
  set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
  set(CPACK_STRIP_FILES ON)
  set(CPACK_VERBATIM_VARIABLES ON)
  set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
    OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
  clusterbench_debian_variables()
  include(CPack)
endfunction()

# The part without a component, the program, is called Unspecified by cpack.
macro(clusterbench_debian_variables)
  set(CPACK_DEBIAN_PACKAGE_MAINTAINER "${CLUSTERBENCH_MAINTAINER}")
  set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
  set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
  set(CPACK_DEBIAN_UNSPECIFIED_PACKAGE_NAME clusterbench)
  set(CPACK_DEBIAN_UNSPECIFIED_FILE_NAME DEB-DEFAULT)
  set(CPACK_DEBIAN_UNSPECIFIED_PACKAGE_SECTION graphics)
  set(CPACK_DEBIAN_UNSPECIFIED_PACKAGE_SUGGESTS "libvulkan1, valgrind")
  set(CPACK_COMPONENT_UNSPECIFIED_DESCRIPTION
    "Loads glTF levels, runs the methods that list the lights of each cell of a\ngrid, and reports exact errors, buffer sizes and times.")
  set(CPACK_DEBIAN_LIBRARY_PACKAGE_NAME clusterbench-dev)
  set(CPACK_DEBIAN_LIBRARY_FILE_NAME DEB-DEFAULT)
  set(CPACK_DEBIAN_LIBRARY_PACKAGE_SECTION libdevel)
  set(CPACK_DEBIAN_LIBRARY_PACKAGE_DEPENDS libhwy-dev)
  set(CPACK_DEBIAN_LIBRARY_PACKAGE_SHLIBDEPS OFF)
  set(CPACK_COMPONENT_LIBRARY_DESCRIPTION
    "The static library that engines link to make light lists, and the headers\nof plug-ins.")
endmacro()
