// SPDX-License-Identifier: LGPL-2.1-or-later
#define CATCH_CONFIG_RUNNER
#include <undine/base/parallel/single_process.h>

#include <deal.II/base/mpi.h>

#include <catch2/catch.hpp>

int
main(int argc, char **argv)
{
  undine::tell_mpi_if_process_is_alone();
  // Catch2 reads the arguments; MPI_InitFinalize must not consume them.
  int                                      no_arguments = 1;
  dealii::Utilities::MPI::MPI_InitFinalize mpi(no_arguments, argv, 1);
  return Catch::Session().run(argc, argv);
}
