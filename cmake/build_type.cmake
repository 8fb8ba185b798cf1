# SPDX-License-Identifier: MIT
# hmps_tell_build_type(): says, once for each build, if nothing tells the compiler to optimise. It does not change the
# build type.
function(hmps_tell_build_type)
  get_property(several GLOBAL PROPERTY GENERATOR_IS_MULTI_CONFIG)
  get_property(told GLOBAL PROPERTY HMPS_BUILD_TYPE_TOLD)
  if(told OR several OR CMAKE_BUILD_TYPE OR CMAKE_CXX_FLAGS MATCHES "-O")
    return()
  endif()
  set_property(GLOBAL PROPERTY HMPS_BUILD_TYPE_TOLD ON)
  message(STATUS "hmps: no build type is set, so the compiler does not optimise, and the sweeps over particles take "
                 "250 times as long: configure with -D CMAKE_BUILD_TYPE=Release")
endfunction()
