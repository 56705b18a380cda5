// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/core/errors.h>
#include <undine/base/core/interruption.h>
#include <undine/base/options/utf8.h>
#include <undine/base/parallel/blas_threads.h>
#include <undine/base/parallel/single_process.h>
#include <undine/driver/command_line.h>
#include <undine/driver/out_of_memory.h>
#include <undine/driver/run.h>

#include <deal.II/base/mpi.h>

#include <chrono>
#include <exception>
#include <filesystem>
#include <iostream>
#include <new>
#include <string>
#include <thread>

namespace
{
  /// True if every rank comes here within a few seconds: all of them have the same error.
  bool
  all_ranks_are_here()
  {
    MPI_Request request;
    MPI_Ibarrier(MPI_COMM_WORLD, &request);
    constexpr int patience = 300; // of 10 ms
    int           complete = 0;
    for (int wait = 0; wait < patience && complete == 0; ++wait)
      {
        MPI_Test(&request, &complete, MPI_STATUS_IGNORE);
        std::this_thread::sleep_for(std::chrono::milliseconds(complete == 0 ? 10 : 0));
      }
    return complete != 0;
  }


  /// Print why the run ends and leave with `code`. An error of all ranks is printed by the first;
  /// one that only some ranks have must end the others too, which wait for them.
  int
  leave(const std::string &message, const int code)
  {
    const bool together = all_ranks_are_here();
    if (!together || dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      std::cerr << '\n' << undine::printable(message) << std::endl;
    if (!together)
      MPI_Abort(MPI_COMM_WORLD, code);
    return code;
  }
} // namespace


int
main(int argc, char **argv)
{
  undine::tell_mpi_if_process_is_alone();
  // The arguments are ours; one thread a rank, so that ranks times threads is what the user says.
  int                                      no_arguments = 1;
  dealii::Utilities::MPI::MPI_InitFinalize mpi(no_arguments, argv, 1);
  undine::use_one_thread_for_blas();
  undine::end_run_when_out_of_memory();
  try
    {
      const auto request = undine::read_command_line(argc, argv, MPI_COMM_WORLD);
      undine::execute(request, MPI_COMM_WORLD);
      return request.exit_code;
    }
  catch (const undine::Interruption &reason)
    {
      return leave(reason.what(), reason.exit_code());
    }
  catch (const undine::Error &error)
    {
      return leave(std::string("Error: ") + error.what(), error.exit_code());
    }
  catch (const std::bad_alloc &)
    {
      return leave("Error: out of memory. Try fewer cells or refinements, or more machines.", 6);
    }
  catch (const std::filesystem::filesystem_error &error)
    {
      return leave("Error: the file or folder '" + error.path1().string() +
                     "' cannot be used: " + error.code().message() +
                     ". Check the name and the permissions of the folders on its path.",
                   undine::FileError("").exit_code());
    }
  catch (const std::exception &error)
    {
      return leave(
        std::string("Error: an unexpected condition, please report it:\n") + error.what(), 5);
    }
}
