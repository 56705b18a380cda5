// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/grid/field_algebra.h>
#include <undine/fluid/viscosity/face_unknowns.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace undine
{
  template <int dim>
  FaceUnknowns<dim>::FaceUnknowns(const FluidModel<dim>                    &model,
                                  const unsigned int                        axis,
                                  std::shared_ptr<const FluidTopology<dim>> topology)
    : fluid(model)
    , direction(axis)
    , open(std::move(topology))
    , numbers(model.grid().faces(axis), open)
  {
    namespace mpi           = dealii::Utilities::MPI;
    const auto communicator = model.grid().communicator();
    Number     count        = 0;
    for_each_value(numbers, [&](double &, const auto &, const auto &) { ++count; });
    mine =
      mpi::create_ascending_partitioning(communicator, count)[mpi::this_mpi_process(communicator)];
    Number next = count > 0 ? mine.nth_index_in_set(0) : 0;
    for_each_value(numbers, [&](double &number, const auto &, const auto &) { number = next++; });
    numbers.exchange(1);
  }


  template <int dim>
  dealii::IndexSet
  FaceUnknowns<dim>::relevant() const
  {
    std::vector<Number> rows(mine.begin(), mine.end());
    const auto         &divided = open->faces[direction];
    for_each(numbers.stored(), [&](const GridIndex<dim> &face) {
      if (divided.kind(face) == SubLattice<dim>::Kind::whole)
        rows.push_back(number({face, -1}));
    });
    for (const double number : numbers.parts())
      rows.push_back(static_cast<Number>(number));
    std::sort(rows.begin(), rows.end());
    dealii::IndexSet result(mine.size());
    result.add_indices(rows.begin(), std::unique(rows.begin(), rows.end()));
    result.compress();
    return result;
  }


  template <int dim>
  typename FaceUnknowns<dim>::Number
  FaceUnknowns<dim>::number(const FacePlace<dim> &place) const
  {
    return static_cast<Number>(value_at(numbers, place));
  }


  template <int dim>
  double
  FaceUnknowns<dim>::mass(const FacePlace<dim> &place) const
  {
    return fluid.density() * (place.part < 0 ? fluid.grid().dual_volume(direction, place.face)
                                             : open->pieces[direction][place.part].volume);
  }


  template <int dim>
  bool
  FaceUnknowns<dim>::is_prescribed(const FacePlace<dim> &place) const
  {
    if (!fluid.grid().at_boundary(direction, place.face))
      return false;
    const Side side{direction, place.face[direction] == 0 ? 0u : 1u};
    return fluid.boundaries().at(side, place.face).prescribes_normal_velocity();
  }


  template <int dim>
  typename FaceUnknowns<dim>::Vector
  FaceUnknowns<dim>::vector() const
  {
    return Vector(mine, fluid.grid().communicator());
  }


  template <int dim>
  void
  FaceUnknowns<dim>::copy(Field<dim> &field, const Vector &values) const
  {
    std::size_t k = 0;
    for_each_owned([&](const FacePlace<dim> &place) {
      const double value = values.begin()[k++];
      if (place.part < 0)
        field(place.face) = value;
      else
        field.parts()[place.part] = value;
    });
    set_means(field, fluid.grid());
    field.exchange(1);
  }


  template <int dim>
  std::size_t
  FaceUnknowns<dim>::memory_consumption() const
  {
    return numbers.memory_consumption();
  }


  template class FaceUnknowns<2>;
  template class FaceUnknowns<3>;
} // namespace undine
