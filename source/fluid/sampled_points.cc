// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/sampled_points.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <map>

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


    /// Position of a point in the whole lattice, place, value, measure.
    template <int dim>
    using Named = std::array<double, dim + 3>;


    /// The owned parts of a field that each rank may see.
    template <int dim>
    std::map<unsigned int, std::vector<Named<dim>>>
    parts_for_ranks(const Field<dim> &field, const GridIndex<dim> &width)
    {
      std::map<unsigned int, std::vector<Named<dim>>> result;

      const auto         &lattice = field.lattice();
      const IndexBox<dim> whole{{}, lattice.shape()};
      for (unsigned int rank = 0; rank < lattice.blocks().n_ranks(); ++rank)
        {
          const auto box = lattice.with_ghosts(rank, width);
          for (std::size_t k = 0; k < field.parts().size(); ++k)
            if (const auto &part = field.divided()->all()[k];
                field.divided()->owns(k) && reaches(lattice, box, part.index))
              {
                Named<dim> named{};
                named[0] = whole.position(part.index);
                for (unsigned int d = 0; d < dim; ++d)
                  named[1 + d] = part.place[d];
                named[dim + 1] = field.parts()[k];
                named[dim + 2] = part.measure;
                result[rank].push_back(named);
              }
        }
      return result;
    }
  } // namespace


  template <int dim>
  SampledPoints<dim>::SampledPoints(const Field<dim>        &field_,
                                    const GridIndex<dim>    &width,
                                    const Obstruction<dim>  &obstruction,
                                    const BodyVicinity<dim> &vicinity)
    : field(field_)
    , kinds(field.stored().size(), Kind::value)
  {
    find_kinds(width, obstruction);
    gather_parts(width, obstruction, vicinity);
  }


  template <int dim>
  void
  SampledPoints<dim>::find_kinds(const GridIndex<dim> &width, const Obstruction<dim> &obstruction)
  {
    using Left         = typename LatticeParts<dim>::Kind;
    const auto &stored = field.stored();
    if (const auto *divided = field.divided())
      {
        Field<dim> left(field.shared_lattice());
        for_each(left.owned(), [&](const GridIndex<dim> &index) {
          left(index) = static_cast<int>(divided->kind(index));
        });
        left.exchange(width);
        for_each(stored, [&](const GridIndex<dim> &index) {
          const auto kind               = static_cast<Left>(static_cast<int>(left(inside(index))));
          kinds[stored.position(index)] = kind == Left::whole    ? Kind::value
                                          : kind == Left::closed ? Kind::nothing
                                                                 : Kind::parts;
        });
      }
    obstruction.for_each_swept(field.lattice(), stored, [&](const GridIndex<dim> &index) {
      auto &kind = kinds[stored.position(index)];
      if (kind == Kind::value)
        kind = Kind::nothing;
    });
  }


  template <int dim>
  void
  SampledPoints<dim>::gather_parts(const GridIndex<dim>    &width,
                                   const Obstruction<dim>  &obstruction,
                                   const BodyVicinity<dim> &vicinity)
  {
    if (field.divided() == nullptr)
      return;
    const auto &lattice  = field.lattice();
    const auto  received = dealii::Utilities::MPI::some_to_some(lattice.blocks().communicator(),
                                                               parts_for_ranks(field, width));
    lists.resize(1);
    std::unordered_map<std::size_t, unsigned int> number; // of a point's list
    for (const auto &message : received)
      for (const auto &named : message.second)
        {
          Sample sample;
          for (unsigned int d = 0; d < dim; ++d)
            sample.place.point[d] = named[1 + d];
          sample.place   = vicinity.place(sample.place.point);
          sample.value   = named[dim + 1];
          sample.measure = named[dim + 2];
          if (obstruction.swept(sample.place.point))
            continue;
          const auto inserted = number.emplace(static_cast<std::size_t>(named[0]), lists.size());
          if (inserted.second)
            lists.emplace_back();
          lists[inserted.first->second].push_back(sample);
        }
    const IndexBox<dim> whole{{}, lattice.shape()};
    list_of_point.assign(kinds.size(), 0);
    for_each(field.stored(), [&](const GridIndex<dim> &index) {
      if (kinds[field.stored().position(index)] != Kind::parts)
        return;
      const auto found = number.find(whole.position(lattice.wrapped(inside(index))));
      if (found != number.end())
        list_of_point[field.stored().position(index)] = found->second;
    });
  }


  template <int dim>
  typename SampledPoints<dim>::Sample
  SampledPoints<dim>::image_of(Sample                sample,
                               const GridIndex<dim> &point,
                               const GridIndex<dim> &own) const
  {
    sample.place.point += field.lattice().point(point) - field.lattice().point(own);
    for (unsigned int d = 0; d < dim; ++d)
      sample.place.cell[d] += point[d] - own[d];
    return sample;
  }


  template <int dim>
  GridIndex<dim>
  SampledPoints<dim>::inside(GridIndex<dim> index) const
  {
    for (unsigned int d = 0; d < dim; ++d)
      if (const auto &row = field.lattice().row(d); !row.periodic())
        index[d] = std::clamp(index[d], 0, row.size() - 1);
    return index;
  }


  template <int dim>
  typename SampledPoints<dim>::Place
  SampledPoints<dim>::located(const GridIndex<dim> &index) const
  {
    const auto &lattice = field.lattice();
    auto        cell    = inside(index);
    if (const auto axis = lattice.normal_axis(); axis < dim && !lattice.row(axis).periodic())
      cell[axis] = std::min(cell[axis], lattice.row(axis).size() - 2);
    return {lattice.point(index), cell};
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
    if (const auto axis = field.lattice().normal_axis(); axis < dim)
      cells.upper[axis] = cells.lower[axis];
    for (int &index : cells.upper.values)
      ++index;
    return cells;
  }


  template class SampledPoints<2>;
  template class SampledPoints<3>;
} // namespace undine
