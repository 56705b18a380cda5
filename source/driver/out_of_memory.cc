// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/driver/out_of_memory.h>

#include <deal.II/base/mpi.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <new>

#include <unistd.h>

namespace undine
{
  namespace
  {
    // What the last words and MPI need; given back to the system when memory is out.
    constexpr std::size_t reserve_size = 16 << 20;
    void                 *reserve      = nullptr;
    std::atomic<bool>     is_armed{false};

    char message[200]; // made beforehand


    /// Returns where nothing has been asked of end_run_when_out_of_memory(), or no more.
    void
    end_run()
    {
      if (is_armed.exchange(false))
        {
          std::free(reserve);
          // Nothing can be done if this fails, too.
          [[maybe_unused]] const auto written = write(STDERR_FILENO, message, std::strlen(message));
          int                         is_finished = 0, n_ranks = 1;
          MPI_Finalized(&is_finished);
          if (is_finished == 0)
            MPI_Comm_size(MPI_COMM_WORLD, &n_ranks);
          if (n_ranks > 1)
            MPI_Abort(MPI_COMM_WORLD, exit_code_of_memory);
          _exit(exit_code_of_memory);
        }
      if (reserve != nullptr)
        _exit(exit_code_of_memory); // not even the reserve has sufficed
    }


    /// What was allocated; ends the run if that is nothing. Sanitizers allocate without it.
    [[maybe_unused]] void *
    checked(void *memory, const std::size_t size)
    {
      if (memory == nullptr && size > 0)
        end_run();
      return memory;
    }
  } // namespace


  void
  end_run_when_out_of_memory()
  {
    std::snprintf(message,
                  sizeof(message),
                  "\nError: out of memory on rank %u of %u. Try fewer cells or refinements, or "
                  "more machines.\n",
                  dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD),
                  dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD));
    reserve  = std::malloc(reserve_size);
    is_armed = true;
    std::set_new_handler([] {
      end_run();
      throw std::bad_alloc();
    });
  }
} // namespace undine


// Libraries in C and Fortran check the result of malloc() late or never (ML goes on with a null
// pointer), or take it for something else (MUMPS for a singular matrix). So these names, by which
// all libraries allocate, lead here first. Sanitizers have their own.
#if defined(__has_feature) // of Clang, which does not define the names of GCC
#  if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#    define UNDINE_SANITIZED
#  endif
#endif
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#  define UNDINE_SANITIZED
#endif
#if defined(__GLIBC__) && !defined(UNDINE_SANITIZED)
extern "C"
{
  // NOLINTBEGIN(bugprone-reserved-identifier): names of glibc
  void *__libc_malloc(std::size_t);
  void *__libc_calloc(std::size_t, std::size_t);
  void       *
  __libc_realloc(void *, std::size_t);
  void *__libc_memalign(std::size_t, std::size_t);
  // NOLINTEND(bugprone-reserved-identifier)


  void *
  malloc(const std::size_t size)
  {
    return undine::checked(__libc_malloc(size), size);
  }


  void *
  calloc(const std::size_t n, const std::size_t size)
  {
    return undine::checked(__libc_calloc(n, size), n * size);
  }


  void *
  realloc(void *memory, const std::size_t size)
  {
    return undine::checked(__libc_realloc(memory, size), size);
  }


  void *
  aligned_alloc(const std::size_t alignment, const std::size_t size)
  {
    return undine::checked(__libc_memalign(alignment, size), size);
  }


  int
  posix_memalign(void **memory, const std::size_t alignment, const std::size_t size)
  {
    if (alignment % sizeof(void *) != 0 || (alignment & (alignment - 1)) != 0 || alignment == 0)
      return EINVAL;
    void *allocated = undine::checked(__libc_memalign(alignment, size), size);
    if (allocated == nullptr && size > 0)
      return ENOMEM;
    *memory = allocated;
    return 0;
  }
}
#endif
