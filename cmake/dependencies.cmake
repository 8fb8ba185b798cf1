# SPDX-License-Identifier: MIT
# Eigen and nanoflann: targets that a parent project has already, otherwise installed packages, otherwise a pinned
# download. The download is only unpacked, never configured, so that none of its options, tests and install rules get
# into the user's build. HMPS_BUNDLED lists what was downloaded.
set(HMPS_BUNDLED "")
include(${CMAKE_CURRENT_LIST_DIR}/find.cmake)

# hmps_archive(<package> <url> <variable>): downloads the archive once. If that is not possible, it ends the
# configuration with a message that says what to install, whereas FetchContent would try for more than a minute and not
# say what is missing.
function(hmps_archive package url variable)
  set(remedy "install Eigen and nanoflann (Debian, Ubuntu: apt install libeigen3-dev libnanoflann-dev; vcpkg: eigen3, nanoflann)")
  if(NOT HMPS_DOWNLOAD_DEPENDENCIES)
    message(FATAL_ERROR "hmps: ${package} was not found and HMPS_DOWNLOAD_DEPENDENCIES is off: ${remedy}")
  endif()
  set(archive ${CMAKE_CURRENT_BINARY_DIR}/downloads/${package}.tar.gz)
  if(NOT EXISTS ${archive})
    file(DOWNLOAD ${url} ${archive}.part STATUS status TIMEOUT 300 INACTIVITY_TIMEOUT 10)
    list(GET status 0 code)
    list(GET status 1 text)
    if(NOT code EQUAL 0)
      file(REMOVE ${archive}.part)
      message(FATAL_ERROR "hmps: ${package} was not found and ${url} cannot be downloaded (${text}): ${remedy}")
    endif()
    file(RENAME ${archive}.part ${archive})
  endif()
  set(${variable} ${archive} PARENT_SCOPE)
endfunction()

# hmps_dependency(<package> <target> <version> <folder of the headers in the archive> <url> <hash>)
function(hmps_dependency package target version folder url hash)
  set(HMPS_${package}_VERSION ${version} PARENT_SCOPE)
  if(TARGET ${target})
    return()
  endif()
  hmps_find(${package} ${target} ${version})
  if(TARGET ${target})
    get_target_property(imported ${target} IMPORTED)
    if(imported)
      set_target_properties(${target} PROPERTIES IMPORTED_GLOBAL TRUE)  # seen by a parent project as well
    endif()
    message(STATUS "hmps: ${package} ${${package}_VERSION} found in ${${package}_DIR}")
    return()
  endif()

  message(STATUS "hmps: ${package} not found, taking it from ${url}")
  include(FetchContent)
  if(POLICY CMP0135)
    cmake_policy(SET CMP0135 NEW)
  endif()
  string(TOUPPER hmps_${package} upper)
  if(NOT FETCHCONTENT_SOURCE_DIR_${upper} AND NOT FETCHCONTENT_FULLY_DISCONNECTED)
    hmps_archive(${package} ${url} url)
  endif()
  # The folder SOURCE_SUBDIR does not exist, so MakeAvailable unpacks the archive and finds nothing to add.
  FetchContent_Declare(hmps_${package} URL ${url} URL_HASH SHA256=${hash} SOURCE_SUBDIR hmps-unpack-only)
  FetchContent_MakeAvailable(hmps_${package})
  string(TOLOWER hmps_${package} content)
  add_library(${target} INTERFACE IMPORTED GLOBAL)
  target_include_directories(${target} INTERFACE ${${content}_SOURCE_DIR}/${folder})
  set(HMPS_BUNDLED ${HMPS_BUNDLED} ${package} PARENT_SCOPE)
  set(HMPS_${package}_HEADERS ${${content}_SOURCE_DIR}/${folder} PARENT_SCOPE)
endfunction()

hmps_dependency(
  Eigen3 Eigen3::Eigen 3.4 "."
  https://gitlab.com/libeigen/eigen/-/archive/3.4.0/eigen-3.4.0.tar.gz
  8586084f71f9bde545ee7fa6d00288b264a2b7ac3607b974e54d13e7162c1c72)
hmps_dependency(
  nanoflann nanoflann::nanoflann 1.4 "include"
  https://github.com/jlblancoc/nanoflann/archive/refs/tags/v1.4.3.tar.gz
  cbcecf22bec528a8673a113ee9b0e134f91f1f96be57e913fa1f74e98e4449fa)
