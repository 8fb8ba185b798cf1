# SPDX-License-Identifier: MIT
# Installs the headers and the CMake package. What was downloaded for want of an installed package
# is installed beside it, so that the package also works where Eigen or nanoflann is still missing.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(HMPS_CMAKE_DIR ${CMAKE_INSTALL_DATADIR}/cmake/hmps)
set(HMPS_BUNDLE_DIR ${CMAKE_INSTALL_DATADIR}/hmps/third_party)

install(TARGETS hmps EXPORT hmpsTargets FILE_SET HEADERS DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(EXPORT hmpsTargets NAMESPACE hmps:: DESTINATION ${HMPS_CMAKE_DIR})

configure_package_config_file(
  cmake/hmpsConfig.cmake.in hmpsConfig.cmake
  INSTALL_DESTINATION ${HMPS_CMAKE_DIR}
  PATH_VARS HMPS_BUNDLE_DIR
  NO_SET_AND_CHECK_MACRO)
# Before 1.0 a new minor version may change the interface.
write_basic_package_version_file(hmpsConfigVersion.cmake COMPATIBILITY SameMinorVersion ARCH_INDEPENDENT)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/hmpsConfig.cmake ${CMAKE_CURRENT_BINARY_DIR}/hmpsConfigVersion.cmake
        DESTINATION ${HMPS_CMAKE_DIR})
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/hmps)

if("Eigen3" IN_LIST HMPS_BUNDLED)
  install(DIRECTORY ${HMPS_Eigen3_HEADERS}/Eigen DESTINATION ${HMPS_BUNDLE_DIR}/Eigen3)
  file(GLOB licences ${HMPS_Eigen3_HEADERS}/COPYING.*)
  install(FILES ${licences} DESTINATION ${HMPS_BUNDLE_DIR}/Eigen3)
endif()
if("nanoflann" IN_LIST HMPS_BUNDLED)
  install(FILES ${HMPS_nanoflann_HEADERS}/nanoflann.hpp DESTINATION ${HMPS_BUNDLE_DIR}/nanoflann)
endif()
