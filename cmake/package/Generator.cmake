# What differs between the forms that cpack packs: Debian's packages lie in /usr, and the library is a package of its own; archives
# (generator External) are written by Archive.cmake.
if(CPACK_GENERATOR STREQUAL "DEB")
  set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
  set(CPACK_DEB_COMPONENT_INSTALL ON)
endif()
if(CPACK_GENERATOR STREQUAL "External")
  set(CPACK_EXTERNAL_ENABLE_STAGING ON)
  set(CPACK_EXTERNAL_PACKAGE_SCRIPT ${CPACK_CLUSTERBENCH_SOURCE}/cmake/package/Archive.cmake)
endif()
