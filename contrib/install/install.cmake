# SPDX-License-Identifier: LGPL-2.1-or-later
# cmake --install BUILD --prefix PREFIX: the program, what it needs of Python, scenes and documents.
# bin/undine finds the other parts from where it lies, so that the whole may be moved.
include(GNUInstallDirs)
set(UNDINE_PROGRAM_DIR ${CMAKE_INSTALL_LIBEXECDIR}/undine)
set(UNDINE_SHARE_DIR ${CMAKE_INSTALL_DATAROOTDIR}/undine)
set(UNDINE_DOC_DIR ${CMAKE_INSTALL_DATAROOTDIR}/doc/undine)
file(RELATIVE_PATH UNDINE_PROGRAM_FROM_BIN ${CMAKE_INSTALL_FULL_BINDIR}
     ${CMAKE_INSTALL_FULL_LIBEXECDIR}/undine)
file(RELATIVE_PATH UNDINE_SHARE_FROM_BIN ${CMAKE_INSTALL_FULL_BINDIR}
     ${CMAKE_INSTALL_FULL_DATAROOTDIR}/undine)
configure_file(${CMAKE_CURRENT_LIST_DIR}/undine.in ${PROJECT_BINARY_DIR}/installed/undine @ONLY)

install(TARGETS undine DESTINATION ${UNDINE_PROGRAM_DIR})
install(PROGRAMS ${PROJECT_BINARY_DIR}/installed/undine DESTINATION ${CMAKE_INSTALL_BINDIR})
install(FILES contrib/launch.sh DESTINATION ${UNDINE_SHARE_DIR})
# Studies name values of the literature by ../../tests/reference.
install(DIRECTORY study report prm DESTINATION ${UNDINE_SHARE_DIR} PATTERN __pycache__ EXCLUDE)
install(DIRECTORY tests/reference DESTINATION ${UNDINE_SHARE_DIR}/tests)
install(PROGRAMS contrib/render DESTINATION ${UNDINE_SHARE_DIR}/contrib)
install(DIRECTORY contrib/rendering DESTINATION ${UNDINE_SHARE_DIR}/contrib
        PATTERN __pycache__ EXCLUDE)

install(FILES README.md LICENSE CITATION.cff CHANGELOG.md CONTRIBUTING.md VERSION
        DESTINATION ${UNDINE_DOC_DIR})
install(DIRECTORY doc DESTINATION ${UNDINE_DOC_DIR} PATTERN changes EXCLUDE)
# Where ./undine doc has made it.
install(DIRECTORY ${PROJECT_BINARY_DIR}/doc/html DESTINATION ${UNDINE_DOC_DIR} OPTIONAL)
