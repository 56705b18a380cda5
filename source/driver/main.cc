// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/core/errors.h>
#include <undine/driver/command_line.h>
#include <undine/driver/run.h>

#include <deal.II/base/mpi.h>

#include <chrono>
#include <exception>
#include <iostream>
#include <thread>

namespace
{
  /// Print why the run failed and leave with `code`. An error that only one rank has seen must end
  /// the others too, which wait for it; one that all have seen is printed once, by the first.
  int
  fail(const std::string &message, const int code)
  {
    const MPI_Comm everyone = MPI_COMM_WORLD;
    if (dealii::Utilities::MPI::this_mpi_process(everyone) != 0)
      std::this_thread::sleep_for(std::chrono::seconds(2));
    std::cerr << "\nError: " << message << std::endl;
    if (dealii::Utilities::MPI::n_mpi_processes(everyone) > 1)
      MPI_Abort(everyone, code);
    return code;
  }
} // namespace


int
main(int argc, char **argv)
{
  // The arguments are ours; one thread a rank, so that ranks times threads is what the user says.
  int                                      no_arguments = 1;
  dealii::Utilities::MPI::MPI_InitFinalize mpi(no_arguments, argv, 1);
  try
    {
      const bool first_rank = dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;
      const auto request    = undine::read_command_line(argc, argv, first_rank);
      undine::execute(request, MPI_COMM_WORLD);
      return request.exit_code;
    }
  catch (const undine::Error &error)
    {
      return fail(error.what(), error.exit_code());
    }
  catch (const std::exception &error)
    {
      return fail(std::string("an unexpected condition, please report it:\n") + error.what(), 5);
    }
}
