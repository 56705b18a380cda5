// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/visibility/sampled_points.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <unordered_map>

namespace undine
{
  namespace
  {
    /// Do the points within a rank's reach, `box`, hold this one or an image of it?
    template <int dim>
    bool
    reaches(const Lattice<dim> &lattice, const IndexBox<dim> &box, const GridIndex<dim> &index)
    {
      for (unsigned int d = 0; d < dim; ++d)
        {
          const int period = lattice.row(d).periodic() ? lattice.row(d).size() : 0;
          bool      inside = false;
          for (const int shift : {-period, 0, period})
            inside =
              inside || (index[d] + shift >= box.lower[d] && index[d] + shift < box.upper[d]);
          if (!inside)
            return false;
        }
      return true;
    }


    /// Position of a point in the whole lattice, place, measure.
    template <int dim>
    using Named = std::array<double, dim + 2>;
  } // namespace


  template <int dim>
  SampledPoints<dim>::SampledPoints(const Field<dim>        &like,
                                    const GridIndex<dim>    &width,
                                    const Obstruction<dim>  &obstruction,
                                    const BodyVicinity<dim> &vicinity,
                                    const Enters            &enters)
    : lattice(like.shared_lattice())
    , open(like.topology())
    , stored(like.stored())
    , kinds(stored.size(), Kind::value)
    , comes_in(stored.size(), 0)
  {
    find_kinds(width, obstruction);
    if (!open)
      return;
    find_parts_for_ranks(width);
    gather_parts(obstruction, vicinity);
    if (enters)
      find_what_comes_in(enters);
  }


  /// At boundary points beyond one side.
  template <int dim>
  void
  SampledPoints<dim>::find_what_comes_in(const Enters &enters)
  {
    for_each(stored, [&](const GridIndex<dim> &index) {
      if (kinds[stored.position(index)] != Kind::parts)
        return;
      const auto   within  = inside(index);
      unsigned int n_sides = 0, axis = 0;
      for (unsigned int d = 0; d < dim; ++d)
        if (index[d] != within[d])
          {
            axis = d;
            ++n_sides;
          }
      if (n_sides != 1)
        return;
      auto own                         = lattice->wrapped(within);
      own[axis]                        = index[axis];
      comes_in[stored.position(index)] = enters(axis, index[axis] < within[axis] ? 0 : 1, own);
    });
  }


  template <int dim>
  void
  SampledPoints<dim>::find_kinds(const GridIndex<dim> &width, const Obstruction<dim> &obstruction)
  {
    using Left = typename SubLattice<dim>::Kind;
    if (open)
      {
        const auto &divided = open->of(*lattice);
        Field<dim>  left(lattice);
        for_each(left.owned(), [&](const GridIndex<dim> &index) {
          left(index) = static_cast<int>(divided.kind(index));
        });
        left.exchange(width);
        for_each(stored, [&](const GridIndex<dim> &index) {
          const auto kind               = static_cast<Left>(static_cast<int>(left(inside(index))));
          kinds[stored.position(index)] = kind == Left::whole    ? Kind::value
                                          : kind == Left::closed ? Kind::nothing
                                                                 : Kind::parts;
        });
      }
    obstruction.for_each_freshly_cleared(*lattice, stored, [&](const GridIndex<dim> &index) {
      auto &kind = kinds[stored.position(index)];
      if (kind == Kind::value)
        kind = Kind::nothing;
    });
  }


  template <int dim>
  void
  SampledPoints<dim>::find_parts_for_ranks(const GridIndex<dim> &width)
  {
    const auto &divided = open->of(*lattice);
    for (unsigned int rank = 0; rank < lattice->blocks().n_ranks(); ++rank)
      {
        const auto box = lattice->with_ghosts(rank, width);
        for (unsigned int k = 0; k < divided.all().size(); ++k)
          if (divided.owns(k) && reaches(*lattice, box, divided.all()[k].index))
            parts_for_ranks[rank].push_back(k);
      }
  }


  template <int dim>
  void
  SampledPoints<dim>::gather_parts(const Obstruction<dim>  &obstruction,
                                   const BodyVicinity<dim> &vicinity)
  {
    const IndexBox<dim>                             whole{{}, lattice->shape()};
    std::map<unsigned int, std::vector<Named<dim>>> to_send;
    for (const auto &[rank, numbers] : parts_for_ranks)
      for (const unsigned int k : numbers)
        {
          const auto &part = open->of(*lattice).all()[k];
          Named<dim>  named{};
          named[0] = whole.position(part.index);
          for (unsigned int d = 0; d < dim; ++d)
            named[1 + d] = part.place[d];
          named[dim + 1] = part.measure;
          to_send[rank].push_back(named);
        }
    const auto received =
      dealii::Utilities::MPI::some_to_some(lattice->blocks().communicator(), to_send);
    lists.resize(1);
    std::unordered_map<std::size_t, unsigned int> number; // of a point's list
    std::size_t                                   next = stored.size();
    for (const auto &message : received)
      for (const auto &named : message.second)
        {
          dealii::Point<dim> place;
          for (unsigned int d = 0; d < dim; ++d)
            place[d] = named[1 + d];
          const Sample sample{vicinity.place(place), next++, named[dim + 1]};
          if (obstruction.is_freshly_cleared(place))
            continue;
          const auto inserted = number.emplace(static_cast<std::size_t>(named[0]), lists.size());
          if (inserted.second)
            lists.emplace_back();
          lists[inserted.first->second].push_back(sample);
        }
    list_of_point.assign(kinds.size(), 0);
    for_each(stored, [&](const GridIndex<dim> &index) {
      if (kinds[stored.position(index)] != Kind::parts)
        return;
      const auto found = number.find(whole.position(lattice->wrapped(inside(index))));
      if (found != number.end())
        list_of_point[stored.position(index)] = found->second;
    });
  }


  template <int dim>
  typename SampledPoints<dim>::Values
  SampledPoints<dim>::values(const Field<dim> &field) const
  {
    Assert(is_for(field), dealii::ExcInternalError());
    Values result;
    result.points   = field.data(stored.lower);
    result.n_points = stored.size();
    if (!open)
      return result;
    std::map<unsigned int, std::vector<double>> to_send;
    for (const auto &[rank, numbers] : parts_for_ranks)
      for (const unsigned int k : numbers)
        to_send[rank].push_back(field.parts()[k]);
    for (const auto &message :
         dealii::Utilities::MPI::some_to_some(lattice->blocks().communicator(), to_send))
      result.parts.insert(result.parts.end(), message.second.begin(), message.second.end());
    return result;
  }


  template <int dim>
  typename SampledPoints<dim>::Sample
  SampledPoints<dim>::image_of(Sample                sample,
                               const GridIndex<dim> &point,
                               const GridIndex<dim> &own) const
  {
    sample.place.point += lattice->point(point) - lattice->point(own);
    for (unsigned int d = 0; d < dim; ++d)
      sample.place.cell[d] += point[d] - own[d];
    return sample;
  }


  template <int dim>
  GridIndex<dim>
  SampledPoints<dim>::inside(GridIndex<dim> index) const
  {
    for (unsigned int d = 0; d < dim; ++d)
      if (const auto &row = lattice->row(d); !row.periodic())
        index[d] = std::clamp(index[d], 0, row.size() - 1);
    return index;
  }


  template <int dim>
  typename SampledPoints<dim>::Place
  SampledPoints<dim>::located(const GridIndex<dim> &index) const
  {
    auto cell = inside(index);
    if (const auto axis = lattice->normal_axis(); axis < dim && !lattice->row(axis).periodic())
      cell[axis] = std::min(cell[axis], lattice->row(axis).size() - 2);
    return {lattice->point(index), cell};
  }


  template <int dim>
  IndexBox<dim>
  SampledPoints<dim>::cells_around(const GridIndex<dim> &lower) const
  {
    auto highest = lower;
    for (int &index : highest.values)
      ++index;
    IndexBox<dim> cells{located(lower).cell, located(highest).cell};
    // The upper face of a cell counts as one of the next.
    if (const auto axis = lattice->normal_axis(); axis < dim)
      cells.upper[axis] = cells.lower[axis];
    for (int &index : cells.upper.values)
      ++index;
    return cells;
  }


  template class SampledPoints<2>;
  template class SampledPoints<3>;
} // namespace undine
