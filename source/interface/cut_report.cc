// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/interface/cut_flags.h>
#include <undine/interface/cut_report.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <set>

namespace undine
{
  namespace
  {
    std::string
    names(const unsigned int flags)
    {
      const std::pair<unsigned int, const char *> all[] = {
        {cut_winding, "places inside two bodies or inside-out ones"},
        {cut_loop, "open outlines"},
        {cut_pairing, "unmatched edges"},
        {cut_nesting, "loose islands"},
        {cut_order, "crossings in the wrong order"},
        {cut_negative_area, "negative areas"},
        {cut_negative_volume, "negative volumes"},
        {cut_closure, "surfaces that do not close"},
        {cut_splitting_failed, "facets that could not be split"}};
      std::vector<std::string> found;
      for (const auto &flag : all)
        if (flags & flag.first)
          found.push_back(flag.second);
      return fmt::format("{}", fmt::join(found, ", "));
    }


    template <int dim>
    std::string
    describe(const CutCells<dim> &cut, const Surface<dim> &surface, const int cell)
    {
      std::set<std::string> bodies;
      for (int f = cut.cells[cell].first_fragment; f < cut.end_fragment(cell); ++f)
        bodies.insert('\'' + surface.body_names()[surface.body(cut.fragments[f].facet)] + '\'');
      std::array<double, dim> middle;
      for (unsigned int d = 0; d < dim; ++d)
        middle[d] = cut.block.planes().position(d, cut.cells[cell].index[d]) +
                    cut.block.planes().width(d, cut.cells[cell].index[d]) / 2;
      return fmt::format("{} {} near ({:.4g}): the fluid's cell there has {}.",
                         bodies.size() == 1 ? "Body" : "Bodies",
                         fmt::join(bodies, " and "),
                         fmt::join(middle, ", "),
                         names(cut.cells[cell].flags));
    }
  } // namespace


  template <int dim>
  CutReport
  report(const CutCells<dim> &cut, const Surface<dim> &surface, const MPI_Comm communicator)
  {
    namespace MPI = dealii::Utilities::MPI;
    CutReport result;
    for (int cell = 0; cell < static_cast<int>(cut.cells.size()); ++cell)
      {
        if (!cut.block.owned().contains(cut.cells[cell].index))
          continue;
        ++result.cut_cells;
        if (cut.cells[cell].flags == 0)
          continue;
        if (result.flagged_cells++ == 0)
          result.message = describe(cut, surface, cell);
        if (cut.cells[cell].flags & cut_needs_sampling)
          ++result.sampled_cells;
      }
    const unsigned int ranks = MPI::n_mpi_processes(communicator);
    const unsigned int first = MPI::min(
      result.flagged_cells > 0 ? MPI::this_mpi_process(communicator) : ranks, communicator);
    if (first < ranks)
      result.message = MPI::broadcast(communicator, result.message, first);
    result.cut_cells       = MPI::sum(result.cut_cells, communicator);
    result.flagged_cells   = MPI::sum(result.flagged_cells, communicator);
    result.sampled_cells   = MPI::sum(result.sampled_cells, communicator);
    result.reordered_edges = MPI::sum<unsigned int>(cut.counts.reordered_edges, communicator);
    result.closure         = MPI::max(cut.counts.closure, communicator);
    return result;
  }


  template CutReport
  report(const CutCells<2> &, const Surface<2> &, MPI_Comm);
  template CutReport
  report(const CutCells<3> &, const Surface<3> &, MPI_Comm);
} // namespace undine
