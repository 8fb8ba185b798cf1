# SPDX-License-Identifier: MIT
# Compiles SOURCE with COMPILER and nothing but what PKG_CONFIG says of hmps installed in PREFIX, after the installed tree
# was copied to MOVED: hmps.pc may not know where it was installed.
file(REMOVE_RECURSE ${MOVED})
file(COPY ${PREFIX}/ DESTINATION ${MOVED})
file(GLOB_RECURSE pc_file ${MOVED}/hmps.pc)
get_filename_component(folder "${pc_file}" DIRECTORY)
set(ENV{PKG_CONFIG_PATH} "${folder}:$ENV{PKG_CONFIG_PATH}")
execute_process(COMMAND ${PKG_CONFIG} --cflags --libs hmps OUTPUT_VARIABLE flags COMMAND_ERROR_IS_FATAL ANY)
separate_arguments(flags UNIX_COMMAND "${flags}")
if("${flags}" MATCHES "${PREFIX}/")
  message(FATAL_ERROR "hmps.pc points to where it was installed: ${flags}")
endif()
execute_process(COMMAND ${COMPILER} -std=c++20 ${SOURCE} ${flags} -o ${MOVED}/quick COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${MOVED}/quick COMMAND_ERROR_IS_FATAL ANY)
