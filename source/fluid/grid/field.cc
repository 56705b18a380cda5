// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/grid/field.h>

#include <mpi.h>

#include <map>
#include <set>
#include <utility>

namespace undine
{
  namespace
  {
    /// A box of ghost points of one rank that another owns; its points there have the indices
    /// shifted back by whole periods.
    template <int dim>
    struct Overlap
    {
      unsigned int   rank; ///< the other one
      IndexBox<dim>  box;  ///< indices as the receiver sees them
      GridIndex<dim> shift;
    };


    /// Along one direction, a run of ghost layers that belong to one block.
    struct Run
    {
      int block, shift, lower, upper;
    };


    /// The runs of blocks that cover [lower, upper), as far as there are owned points.
    template <int dim>
    std::vector<Run>
    runs_along(const Lattice<dim> &lattice,
               const unsigned int  direction,
               const int           lower,
               const int           upper)
    {
      std::vector<Run> runs;
      const auto      &row     = lattice.row(direction);
      const auto      &blocks  = lattice.blocks();
      const int        n_cells = blocks.n_cells()[direction];
      int              begin   = row.periodic() ? lower : std::max(lower, 0);
      const int        end     = row.periodic() ? upper : std::min(upper, row.size());
      while (begin < end)
        {
          const int point = row.wrapped(begin);
          const int block = blocks.block_of_cell(direction, std::min(point, n_cells - 1));
          const int after = block + 1 == blocks.n_blocks()[direction]
                              ? row.size()
                              : blocks.first_cell(direction, block + 1);
          const int stop  = std::min(end, begin + after - point);
          runs.push_back({block, begin - point, begin, stop});
          begin = stop;
        }
      return runs;
    }


    /// What `rank` needs from others (and, by periodicity, from itself), in an order on which
    /// sender and receiver agree.
    template <int dim>
    std::vector<Overlap<dim>>
    overlaps(const Lattice<dim> &lattice, const unsigned int rank, const GridIndex<dim> &width)
    {
      const auto                        ghosts = lattice.with_ghosts(rank, width);
      std::array<std::vector<Run>, dim> runs;
      IndexBox<dim>                     choices;
      for (unsigned int d = 0; d < dim; ++d)
        {
          runs[d]          = runs_along(lattice, d, ghosts.lower[d], ghosts.upper[d]);
          choices.upper[d] = runs[d].size();
        }
      std::vector<Overlap<dim>> result;
      for_each(choices, [&](const GridIndex<dim> &choice) {
        Overlap<dim>   overlap;
        GridIndex<dim> block;
        bool           is_image = false;
        for (unsigned int d = 0; d < dim; ++d)
          {
            const auto &run      = runs[d][choice[d]];
            block[d]             = run.block;
            overlap.shift[d]     = run.shift;
            overlap.box.lower[d] = run.lower;
            overlap.box.upper[d] = run.upper;
            is_image             = is_image || run.shift != 0;
          }
        overlap.rank = lattice.blocks().rank_of_block(block);
        if (overlap.rank != rank || is_image)
          result.push_back(overlap);
      });
      return result;
    }


    template <int dim>
    GridIndex<dim>
    shifted_back(GridIndex<dim> index, const GridIndex<dim> &shift)
    {
      for (unsigned int d = 0; d < dim; ++d)
        index[d] -= shift[d];
      return index;
    }


    /// The ranks whose ghost layers hold points of this one: by symmetry those that own some of
    /// this rank's ghosts.
    template <int dim>
    std::set<unsigned int>
    neighbours(const std::vector<Overlap<dim>> &wanted, const unsigned int rank)
    {
      std::set<unsigned int> ranks;
      for (const auto &overlap : wanted)
        if (overlap.rank != rank)
          ranks.insert(overlap.rank);
      return ranks;
    }
  } // namespace


  template <int dim>
  Field<dim>::Field(std::shared_ptr<const Lattice<dim>>       lattice,
                    std::shared_ptr<const FluidTopology<dim>> topology)
    : points(std::move(lattice))
    , open(std::move(topology))
    , part_values(open ? open->of(*points).all().size() : 0)
  {
    store(points->owned());
  }


  template <int dim>
  void
  Field<dim>::store(const IndexBox<dim> &new_box)
  {
    const auto old_box     = box;
    const auto old_strides = strides;
    const auto old_values  = std::move(values);
    box                    = new_box;
    strides[0]             = 1;
    for (unsigned int d = 1; d < dim; ++d)
      strides[d] = strides[d - 1] * (box.upper[d - 1] - box.lower[d - 1]);
    values.assign(box.size(), 0.);
    if (!old_values.empty())
      for_each(old_box.intersection(box), [&](const GridIndex<dim> &index) {
        std::ptrdiff_t old = 0;
        for (unsigned int d = 0; d < dim; ++d)
          old += (index[d] - old_box.lower[d]) * old_strides[d];
        (*this)(index) = old_values[old];
      });
  }


  template <int dim>
  void
  Field<dim>::exchange(const int width)
  {
    exchange(all_directions<dim>(width));
  }


  template <int dim>
  void
  Field<dim>::exchange(const GridIndex<dim> &width)
  {
    const auto &blocks = points->blocks();
    const auto  needed = points->with_ghosts(blocks.rank(), width);
    if (open)
      open->of(*points).exchange(part_values);
    if (!(box.intersection(needed) == needed))
      store(needed);

    std::map<unsigned int, std::vector<double>> incoming, outgoing;
    const auto                                  wanted = overlaps(*points, blocks.rank(), width);
    for (const auto &overlap : wanted)
      if (overlap.rank != blocks.rank())
        {
          auto &buffer = incoming[overlap.rank];
          buffer.resize(buffer.size() + overlap.box.size());
        }
    for (const unsigned int rank : neighbours(wanted, blocks.rank()))
      for (const auto &overlap : overlaps(*points, rank, width))
        if (overlap.rank == blocks.rank())
          for_each(overlap.box, [&](const GridIndex<dim> &index) {
            outgoing[rank].push_back((*this)(shifted_back<dim>(index, overlap.shift)));
          });

    std::vector<MPI_Request> requests;
    const int                tag = 517;
    for (auto &[rank, buffer] : incoming)
      MPI_Irecv(buffer.data(),
                buffer.size(),
                MPI_DOUBLE,
                rank,
                tag,
                blocks.communicator(),
                &requests.emplace_back());
    for (auto &[rank, buffer] : outgoing)
      MPI_Isend(buffer.data(),
                buffer.size(),
                MPI_DOUBLE,
                rank,
                tag,
                blocks.communicator(),
                &requests.emplace_back());
    MPI_Waitall(requests.size(), requests.data(), MPI_STATUSES_IGNORE);

    std::map<unsigned int, std::size_t> taken;
    for (const auto &overlap : wanted)
      for_each(overlap.box, [&](const GridIndex<dim> &index) {
        (*this)(index) = overlap.rank == blocks.rank()
                           ? (*this)(shifted_back<dim>(index, overlap.shift))
                           : incoming[overlap.rank][taken[overlap.rank]++];
      });
  }


  template <int dim>
  std::vector<double>
  Field<dim>::owned_values() const
  {
    std::vector<double> result;
    result.reserve(owned().size());
    for_each(owned(), [&](const GridIndex<dim> &index) { result.push_back((*this)(index)); });
    return result;
  }


  template <int dim>
  void
  Field<dim>::set_owned_values(const std::vector<double> &owned_values)
  {
    std::size_t k = 0;
    for_each(owned(), [&](const GridIndex<dim> &index) { (*this)(index) = owned_values[k++]; });
  }


  template class Field<2>;
  template class Field<3>;
} // namespace undine
