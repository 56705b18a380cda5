// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_cutting_cut_report_h
#define undine_cutting_cut_report_h

#include <undine/cutting/cut_cells.h>
#include <undine/surface/surface.h>

#include <deal.II/base/mpi.h>

#include <string>

namespace undine
{
  /// Statistics and errors of cutting, over the owned cells of all ranks.
  struct CutReport
  {
    unsigned int cut_cells       = 0;
    unsigned int flagged_cells   = 0; ///< something is wrong with the surface there
    unsigned int sampled_cells   = 0; ///< of these: resolved by samples, without exact closure
    unsigned int reordered_edges = 0; ///< grid edges with ties, halos counted twice
    double       closure         = 0; ///< worst defect in cells that are not flagged

    /// The bodies and the kind of error in the flagged cell with most bodies in it, the first one
    /// of the lowest rank, such as "'a' and 'b' overlap"; empty if there is none.
    std::string subject;

    /// The same with place and number, what is done about it and what to try.
    std::string message;
  };

  /// The report on `cut`, whose surface is `surface`. Collective.
  template <int dim>
  CutReport
  report(const CutCells<dim> &cut, const Surface<dim> &surface, MPI_Comm communicator);
} // namespace undine

#endif
