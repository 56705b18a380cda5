// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_base_parallel_blas_threads_h
#define undine_base_parallel_blas_threads_h

#include <cstdlib>
#include <dlfcn.h>

namespace undine
{
  /// One thread for BLAS, where that is OpenBLAS, unless the user's environment says how many. The
  /// fronts of sparse factors are small: more threads mostly wait for each other, and where other
  /// processes want the same cores a run takes ten times as long.
  inline void
  use_one_thread_for_blas()
  {
    for (const char *by_user : {"OPENBLAS_NUM_THREADS", "GOTO_NUM_THREADS", "OMP_NUM_THREADS"})
      if (std::getenv(by_user) != nullptr)
        return;
    using SetThreads = void (*)(int);
    if (const auto set =
          reinterpret_cast<SetThreads>(dlsym(RTLD_DEFAULT, "openblas_set_num_threads")))
      set(1);
  }
} // namespace undine

#endif
