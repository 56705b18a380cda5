// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/grid/sub_lattice.h>

#include <deal.II/base/mpi.h>

#include <boost/serialization/utility.hpp>

#include <algorithm>
#include <utility>

namespace undine
{
  namespace
  {
    /// A part as all ranks know it: the position of its point in the whole lattice, and which of
    /// the point's parts it is.
    using Name = std::pair<std::size_t, int>;


    template <int dim>
    unsigned int
    owner(const Lattice<dim> &lattice, const GridIndex<dim> &index)
    {
      const auto    &blocks = lattice.blocks();
      const auto     point  = lattice.wrapped(index);
      GridIndex<dim> block;
      for (unsigned int d = 0; d < dim; ++d)
        block[d] = blocks.block_of_cell(d, std::min(point[d], blocks.n_cells()[d] - 1));
      return blocks.rank_of_block(block);
    }
  } // namespace


  template <int dim>
  IndexBox<dim>
  known_points(const Lattice<dim> &lattice)
  {
    auto box = lattice.owned().grown(all_directions<dim>(1));
    for (unsigned int d = 0; d < dim; ++d)
      if (!lattice.row(d).periodic())
        {
          box.lower[d] = std::max(box.lower[d], 0);
          box.upper[d] = std::min(box.upper[d], lattice.row(d).size());
        }
    return box;
  }


  template <int dim>
  SubLattice<dim>::SubLattice(std::shared_ptr<const Lattice<dim>> lattice_,
                              const std::vector<Kind>            &kinds_,
                              const std::vector<Part>            &parts_)
    : lattice(std::move(lattice_))
    , box(known_points(*lattice))
    , kinds(kinds_)
    , parts(parts_)
  {
    for (unsigned int k = 0; k < parts.size(); ++k)
      {
        const auto place = box.position(parts[k].index);
        first_parts.emplace(place, std::make_pair(k, k)).first->second.second = k + 1;
      }
    find_owners();
  }


  template <int dim>
  void
  SubLattice<dim>::find_owners()
  {
    const IndexBox<dim>                       whole{{}, lattice->shape()};
    std::map<unsigned int, std::vector<Name>> requests;
    for (unsigned int k = 0; k < parts.size(); ++k)
      if (!owns(k))
        {
          const auto         point = lattice->wrapped(parts[k].index);
          const unsigned int rank  = owner(*lattice, point);
          wanted[rank].push_back(k);
          requests[rank].emplace_back(whole.position(point),
                                      static_cast<int>(k) - first(parts[k].index));
        }
    const auto received =
      dealii::Utilities::MPI::some_to_some(lattice->blocks().communicator(), requests);
    for (const auto &[rank, names] : received)
      for (const auto &name : names)
        {
          GridIndex<dim> index;
          auto           rest = name.first;
          for (unsigned int d = 0; d < dim; ++d)
            {
              index[d] = static_cast<int>(rest % whole.upper[d]);
              rest /= whole.upper[d];
            }
          offered[rank].push_back(first(index) + name.second);
        }
  }


  template <int dim>
  void
  SubLattice<dim>::exchange(std::vector<double> &values) const
  {
    std::map<unsigned int, std::vector<double>> outgoing, incoming;
    std::vector<MPI_Request>                    requests;
    const int                                   tag = 518;
    for (const auto &[rank, numbers] : wanted)
      {
        auto &buffer = incoming[rank];
        buffer.resize(numbers.size());
        MPI_Irecv(buffer.data(),
                  buffer.size(),
                  MPI_DOUBLE,
                  rank,
                  tag,
                  lattice->blocks().communicator(),
                  &requests.emplace_back());
      }
    for (const auto &[rank, numbers] : offered)
      {
        auto &buffer = outgoing[rank];
        for (const int number : numbers)
          buffer.push_back(values[number]);
        MPI_Isend(buffer.data(),
                  buffer.size(),
                  MPI_DOUBLE,
                  rank,
                  tag,
                  lattice->blocks().communicator(),
                  &requests.emplace_back());
      }
    MPI_Waitall(requests.size(), requests.data(), MPI_STATUSES_IGNORE);
    for (const auto &[rank, numbers] : wanted)
      for (std::size_t k = 0; k < numbers.size(); ++k)
        values[numbers[k]] = incoming[rank][k];
  }


  template IndexBox<2>
  known_points(const Lattice<2> &);
  template IndexBox<3>
  known_points(const Lattice<3> &);
  template class SubLattice<2>;
  template class SubLattice<3>;
} // namespace undine
