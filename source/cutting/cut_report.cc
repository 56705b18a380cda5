// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/cutting/cut_flags.h>
#include <undine/cutting/cut_report.h>

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


    /// The names of the bodies whose surfaces pass through a cell.
    template <int dim>
    std::set<std::string>
    bodies_in(const CutCells<dim> &cut, const Surface<dim> &surface, const int cell)
    {
      std::set<std::string> bodies;
      for (int f = cut.cells[cell].first_fragment; f < cut.end_fragment(cell); ++f)
        bodies.insert('\'' + surface.body_names()[surface.body(cut.fragments[f].facet)] + '\'');
      return bodies;
    }


    /// What the surfaces in a flagged cell seem to do there.
    template <int dim>
    std::string
    subject(const CutCells<dim> &cut, const Surface<dim> &surface, const int cell)
    {
      const auto  bodies = bodies_in(cut, surface, cell);
      const auto  flags  = cut.cells[cell].flags;
      std::string who    = fmt::format("{}", fmt::join(bodies, " and "));
      if (!(flags & (cut_winding | cut_loop | cut_order | cut_negative_area | cut_negative_volume)))
        return fmt::format("{}: {}", who, names(flags));
      if (bodies.size() > 1)
        return who + " overlap";
      bool inside_out = false;
      for (unsigned int corner = 0; corner < (1u << dim); ++corner)
        {
          auto node = cut.cells[cell].index;
          for (unsigned int d = 0; d < dim; ++d)
            node[d] += (corner >> d) & 1;
          inside_out = inside_out || cut.windings[cut.block.key(node)] < 0;
        }
      if (inside_out)
        return who + " is inside out";
      return who + (surface.body_names().size() > 1 ? " lies in another body or intersects itself"
                                                    : " intersects itself");
    }


    template <int dim>
    std::array<double, dim>
    middle(const CutCells<dim> &cut, const int cell)
    {
      std::array<double, dim> result;
      for (unsigned int d = 0; d < dim; ++d)
        result[d] = cut.block.planes().position(d, cut.cells[cell].index[d]) +
                    cut.block.planes().width(d, cut.cells[cell].index[d]) / 2;
      return result;
    }
  } // namespace


  template <int dim>
  CutReport
  report(const CutCells<dim> &cut, const Surface<dim> &surface, const MPI_Comm communicator)
  {
    namespace MPI = dealii::Utilities::MPI;
    CutReport               result;
    std::array<double, dim> place{};
    unsigned int            most_bodies = 0; // in one flagged cell: it tells most
    for (int cell = 0; cell < static_cast<int>(cut.cells.size()); ++cell)
      {
        if (!cut.block.owned().contains(cut.cells[cell].index))
          continue;
        ++result.cut_cells;
        if (cut.cells[cell].flags == 0)
          continue;
        ++result.flagged_cells;
        if (const unsigned int n_bodies = bodies_in(cut, surface, cell).size();
            n_bodies > most_bodies)
          {
            most_bodies    = n_bodies;
            result.subject = subject(cut, surface, cell);
            place          = middle(cut, cell);
          }
        if (cut.cells[cell].flags & cut_needs_sampling)
          ++result.sampled_cells;
      }
    const unsigned int ranks = MPI::n_mpi_processes(communicator);
    const unsigned int most  = MPI::max(most_bodies, communicator);
    const bool         tells = most > 0 && most_bodies == most;
    const unsigned int first =
      MPI::min(tells ? MPI::this_mpi_process(communicator) : ranks, communicator);
    if (first < ranks)
      {
        result.subject = MPI::broadcast(communicator, result.subject, first);
        place          = MPI::broadcast(communicator, place, first);
      }
    result.cut_cells       = MPI::sum(result.cut_cells, communicator);
    result.flagged_cells   = MPI::sum(result.flagged_cells, communicator);
    result.sampled_cells   = MPI::sum(result.sampled_cells, communicator);
    result.reordered_edges = MPI::sum<unsigned int>(cut.counts.reordered_edges, communicator);
    result.closure         = MPI::max(cut.counts.closure, communicator);
    if (first < ranks)
      result.message = fmt::format(
        "{} near ({:.4g}); {} of the fluid's cells are affected. {}the flow close by is rough, "
        "forces too. Try: move the surfaces apart, mesh what overlaps as one body, or a finer "
        "grid.",
        result.subject,
        fmt::join(place, ", "),
        result.flagged_cells,
        result.sampled_cells > 0 ? "The fluid in these is found by samples, so that " : "There ");
    return result;
  }


  template CutReport
  report(const CutCells<2> &, const Surface<2> &, MPI_Comm);
  template CutReport
  report(const CutCells<3> &, const Surface<3> &, MPI_Comm);
} // namespace undine
