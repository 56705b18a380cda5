# SPDX-License-Identifier: LGPL-2.1-or-later
# The cases of Catch2 programs as tests of ctest. A start of a program costs more than half a second of a
# processor, most of it for the loading of two hundred libraries; there are more than 450 cases.

# What the lines that unit_cases.py writes call, with the variables of undine_unit_cases(). @{
function(undine_unit_serial title filter n_cases)
  set(test "unit/${module}/${title}")
  add_test(NAME "${test}" COMMAND unit_${module} "${filter}" --filenames-as-tags --warn NoTests)
  undine_unit_limits("${test}" ${n_cases} 1)
  if(n_cases EQUAL 1)
    # What needs a device says nothing where there is none: tests/unit/particles/executors.h.
    set_tests_properties("${test}" PROPERTIES SKIP_REGULAR_EXPRESSION "skipped: there is no device")
  endif()
endfunction()

# On several ranks all in one test: three processes that share two processors take seconds to start.
function(undine_unit_parallel n_cases)
  set(short "[mpi]")
  set(long)
  foreach(file ${given_LONG_ON_THREE})
    string(APPEND short "~[#${file}]")
    list(APPEND long "[mpi][#${file}]")
  endforeach()
  list(JOIN long "," long)
  undine_unit_on_ranks(unit/${module}/mpirun=2 2 "[mpi]")
  undine_unit_on_ranks(unit/${module}/mpirun=3 3 "${short}")
  if(long)
    undine_unit_on_ranks(unit/${module}/long.mpirun=3 3 "${long}")
    set_tests_properties(unit/${module}/long.mpirun=3 PROPERTIES LABELS long)
  endif()
endfunction()

function(undine_unit_on_ranks test ranks filter)
  add_test(NAME ${test}
           COMMAND ${DEAL_II_MPIEXEC} -np ${ranks} $<TARGET_FILE:unit_${module}> "${filter}"
                   --filenames-as-tags --warn NoTests)
  undine_unit_limits(${test} ${n_cases} ${ranks})
endfunction()

# Ten minutes a case, half an hour for all of a file.
function(undine_unit_limits test n_cases ranks)
  math(EXPR limit "600 * ${n_cases}")
  if(limit GREATER 1800)
    set(limit 1800)
  endif()
  set_tests_properties("${test}" PROPERTIES
    ENVIRONMENT "${MPI_ENVIRONMENT}" PROCESSORS ${ranks} TIMEOUT ${limit})
endfunction()
# @}


# undine_unit_cases(MODULE SOURCES file.cc... BY_FILE name... LONG_ON_THREE name...) makes of each case in the
# sources of the program unit_MODULE a test unit/MODULE/<name of the case>, but one test unit/MODULE/<name> of all that are in a file
# named after BY_FILE (ALL: in every file), and of all cases tagged [mpi] the tests unit/MODULE/mpirun=2 and 3;
# the latter without files named after LONG_ON_THREE, which are a long test, unit/MODULE/long.mpirun=3.
function(undine_unit_cases module)
  cmake_parse_arguments(PARSE_ARGV 1 given "" "" "SOURCES;BY_FILE;LONG_ON_THREE")
  set(by_file)
  foreach(source ${given_SOURCES})
    get_filename_component(title ${source} NAME_WE)
    if(given_BY_FILE STREQUAL "ALL" OR title IN_LIST given_BY_FILE)
      list(APPEND by_file --by-file ${title})
    endif()
  endforeach()
  set(script ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/unit_cases.py)
  set(written ${CMAKE_CURRENT_BINARY_DIR}/unit_cases_${module}.cmake)
  execute_process(COMMAND ${Python3_EXECUTABLE} -B ${script} write undine_unit ${by_file} ${given_SOURCES}
                  OUTPUT_FILE ${written} COMMAND_ERROR_IS_FATAL ANY)
  include(${written})
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${script} ${given_SOURCES})

  # What unit_cases.py overlooks would be run by nobody.
  set(test unit/${module}/every_case_is_run)
  add_test(NAME ${test}
           COMMAND ${Python3_EXECUTABLE} -B ${script} check $<TARGET_FILE:unit_${module}>
                   ${CMAKE_CTEST_COMMAND} ${CMAKE_CURRENT_BINARY_DIR} unit/${module}/)
  undine_unit_limits(${test} 1 1)
endfunction()
