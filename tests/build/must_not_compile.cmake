# SPDX-License-Identifier: MIT
# Fails unless COMPILER refuses SOURCE with an error that holds the words behind "// expect:" in it, and whose first
# line, after those that say what was included from where, holds the words behind "// first line:", if there are any.
# Flags behind "// flags:" are added to the command.
file(STRINGS ${SOURCE} expected REGEX "^// expect: ")
string(REGEX REPLACE "^// expect: " "" expected "${expected}")
if(expected STREQUAL "")
  message(FATAL_ERROR "${SOURCE} does not say what to expect")
endif()
file(STRINGS ${SOURCE} flags REGEX "^// flags: ")
string(REGEX REPLACE "^// flags: " "" flags "${flags}")
separate_arguments(flags)
list(TRANSFORM INCLUDES PREPEND -I)
execute_process(
  COMMAND ${COMPILER} -std=c++20 ${flags} -fsyntax-only ${INCLUDES} ${SOURCE}
  RESULT_VARIABLE result
  ERROR_VARIABLE errors)
if(result EQUAL 0)
  message(FATAL_ERROR "${SOURCE} compiles, but must not")
endif()
string(FIND "${errors}" "${expected}" position)
if(position EQUAL -1)
  message(FATAL_ERROR "the error does not say '${expected}':\n${errors}")
endif()
file(STRINGS ${SOURCE} first REGEX "^// first line: ")
if(NOT first STREQUAL "")
  string(REGEX REPLACE "^// first line: " "" first "${first}")
  string(REGEX REPLACE "(^|\n)(In file included from| +from)[^\n]*" "" message "${errors}")
  string(REGEX REPLACE "^\n+" "" message "${message}")
  string(REGEX REPLACE "\n.*" "" message "${message}")
  string(FIND "${message}" "${first}" position)
  if(position EQUAL -1)
    message(FATAL_ERROR "the first line does not say '${first}':\n${message}\n\n${errors}")
  endif()
endif()
