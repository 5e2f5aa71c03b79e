# What differs between the forms that cpack packs: Debian's packages lie in /usr, and the library is a package of its own.
if(CPACK_GENERATOR STREQUAL "DEB")
  set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
  set(CPACK_DEB_COMPONENT_INSTALL ON)
endif()
