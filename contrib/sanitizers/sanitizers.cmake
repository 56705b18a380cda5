# SPDX-License-Identifier: LGPL-2.1-or-later
# Builds that find errors while they run, at two to twenty times the time:
#   -DUNDINE_SANITIZE=address,undefined   memory errors, leaks and undefined behaviour, with g++
#   -DUNDINE_SANITIZE=thread              data races of the particle method on the host, built alone by
#                                         CXX=clang++-14 cmake -S cuda -B BUILD
# Sets UNDINE_RELEASE_FLAGS, which come after those of deal.II in release builds, and
# UNDINE_SANITIZER_SOURCE, a source file of every executable that tells the sanitizers their options;
# empty in other builds.
set(UNDINE_SANITIZE "" CACHE STRING "Sanitizers: empty, 'address,undefined' or 'thread'")
set_property(CACHE UNDINE_SANITIZE PROPERTY STRINGS "" "address,undefined" "thread")

set(UNDINE_RELEASE_FLAGS -O3 -g0)
set(UNDINE_SANITIZER_SOURCE)
if(NOT UNDINE_SANITIZE)
  return()
endif()

if(UNDINE_SANITIZE STREQUAL "address,undefined")
  # Casts of numbers that are too large or not-a-number to integers are undefined, but belong to no
  # group. Checks of every access to memory and every call of a virtual function take half of the time
  # to compile and find little that AddressSanitizer does not.
  set(flags -fsanitize=address,undefined,float-cast-overflow
            -fno-sanitize=null,alignment,object-size,vptr)
elseif(UNDINE_SANITIZE STREQUAL "thread")
  # ThreadSanitizer does not see how libgomp's threads wait for each other and takes every pass for a
  # race. LLVM's OpenMP library tells it, by libarcher.
  if(NOT UNDINE_PARTICLES_ALONE OR NOT CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
    message(FATAL_ERROR "UNDINE_SANITIZE=thread is for the particle method alone (MPI and deal.II's "
      "libraries cannot be looked into) and for clang++ with LLVM's OpenMP library (Debian: clang-14 "
      "and libomp-14-dev):\n"
      "  CXX=clang++-14 cmake -S cuda -B build-thread -G Ninja -DUNDINE_SANITIZE=thread")
  endif()
  set(flags -fsanitize=thread)
else()
  message(FATAL_ERROR "UNDINE_SANITIZE=${UNDINE_SANITIZE}: allowed are 'address,undefined' and 'thread'.")
endif()

# CUDA maps memory where the sanitizers keep theirs, and they see nothing of what runs on a device.
if(NOT DEFINED UNDINE_CUDA)
  set(UNDINE_CUDA OFF)
endif()
if(UNDINE_CUDA)
  message(FATAL_ERROR "UNDINE_SANITIZE checks the engine for the host: it needs -DUNDINE_CUDA=OFF.")
endif()

# What _FORTIFY_SOURCE checks would be hidden from AddressSanitizer.
set(UNDINE_RELEASE_FLAGS -O1 -fno-unroll-loops -g1 -U_FORTIFY_SOURCE)
add_compile_options(${flags} -fno-omit-frame-pointer)
# The assertions of libstdc++, which cost little.
add_compile_definitions(_GLIBCXX_ASSERTIONS)
add_link_options(${flags})
set(UNDINE_SANITIZER_SOURCE ${CMAKE_BINARY_DIR}/sanitizer_defaults.cc)
configure_file(${CMAKE_CURRENT_LIST_DIR}/defaults.cc.in ${UNDINE_SANITIZER_SOURCE} @ONLY)
message(STATUS "Sanitizers: ${UNDINE_SANITIZE}")
