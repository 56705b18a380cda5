# SPDX-License-Identifier: LGPL-2.1-or-later
# What programs can check without running Undine: the sources' rules and the answers to bad scenes.
find_package(Python3 3.9 REQUIRED COMPONENTS Interpreter)

add_test(NAME sources/checks_find_faults
         COMMAND ${Python3_EXECUTABLE} -B ${CMAKE_CURRENT_SOURCE_DIR}/test_checks.py)
add_test(NAME sources/include_direction
         COMMAND ${Python3_EXECUTABLE} -B ${CMAKE_CURRENT_SOURCE_DIR}/check_include_direction.py
                 ${PROJECT_SOURCE_DIR})
add_test(NAME sources/style
         COMMAND ${Python3_EXECUTABLE} -B ${CMAKE_CURRENT_SOURCE_DIR}/check_style.py
                 ${PROJECT_SOURCE_DIR})
add_test(NAME sources/layout COMMAND ${PROJECT_SOURCE_DIR}/contrib/indent --check)
