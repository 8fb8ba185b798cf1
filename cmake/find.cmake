# SPDX-License-Identifier: MIT
# hmps_find(<package> <target> <version>): the first package on the user's search path of that version or a later one.
# It does not request <version> from find_package: Eigen 5 refuses a request for 3.4, which would then be taken from
# further down the path, and Eigen 3.4 refuses a range that includes 5. Instead it requests a version that does not
# exist, and find_package then lists the versions that do.
macro(hmps_find package target version)
  if(NOT TARGET ${target})
    find_package(${package} 9999 CONFIG QUIET)
    foreach(hmps_config hmps_version IN ZIP_LISTS ${package}_CONSIDERED_CONFIGS ${package}_CONSIDERED_VERSIONS)
      if(NOT TARGET ${target} AND hmps_version VERSION_GREATER_EQUAL ${version})
        get_filename_component(hmps_config "${hmps_config}" DIRECTORY)
        set(${package}_DIR "${hmps_config}" CACHE PATH "Folder of the package configuration of ${package}" FORCE)
        find_package(${package} CONFIG QUIET)
      endif()
    endforeach()
  endif()
endmacro()
