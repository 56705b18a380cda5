// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/convection/dual_transfer.h>
#include <undine/fluid/grid/cell_links.h>

#include <catch2/catch.hpp>
#include <surface/ball_and_sheet.h>

#include <cmath>

using namespace undine_tests;

namespace
{
  /// The component below (end 0) or above a place; -1: the cell is whole.
  template <int dim>
  int
  component_at(const FluidTopology<dim> &open,
               const unsigned int        axis,
               const FacePlace<dim>     &place,
               const unsigned int        end)
  {
    return place.part < 0 ? -1 : std::max(-1, open.pieces[axis][place.part].components[end]);
  }


  /// What is in components before, of which no two have the same. One ghost layer is up to date.
  template <int dim>
  Field<dim>
  contents(const BallAndSheet<dim> &scene)
  {
    Field<dim> result(scene.grid().cells(), scene.before.parts.open);
    for_each_value(result, [](double &value, const dealii::Point<dim> &place, const auto &) {
      value = 1.5 + std::sin(7 * place[0]) * std::cos(5 * place[dim - 1]);
    });
    result.exchange(1);
    return result;
  }


  /// Volumes around components before, along an axis. One ghost layer is up to date.
  template <int dim>
  Field<dim>
  volumes_around(const BallAndSheet<dim>                  &scene,
                 const typename DualTransfer<dim>::Halves &halves,
                 const unsigned int                        axis)
  {
    const auto &open = scene.before.parts.open;
    Field<dim>  result(scene.grid().cells(), open);
    for_each(result.owned(), [&](const GridIndex<dim> &cell) {
      for (const unsigned int end : {0, 1})
        for_each_place(
          &open->faces[axis], moved<dim>(cell, axis, 1 - end), [&](const FacePlace<dim> &place) {
            value_at(result, cell, component_at(*open, axis, place, end)) +=
              value_at(halves[end], place);
          });
    });
    result.exchange(1);
    return result;
  }


  template <int dim>
  double
  total(const Field<dim> &field)
  {
    double sum = 0;
    for_each_value(field, [&](const double value, const auto &, const auto &) { sum += value; });
    return dealii::Utilities::MPI::sum(sum, MPI_COMM_WORLD);
  }


  /// What a component has is in the halves around it, in proportion to their volumes.
  template <int dim>
  Field<dim>
  after_transfer(const BallAndSheet<dim> &scene,
                 const DualTransfer<dim> &transfer,
                 const unsigned int       axis,
                 const double             staying)
  {
    const auto amounts = contents(scene);
    const auto volumes =
      volumes_around(scene, {{transfer.before[0][axis], transfer.before[1][axis]}}, axis);
    const auto &open = *scene.before.parts.open;
    return transfer.sums_around(
      axis, transfer.transfer(axis, [&](const FacePlace<dim> &place, const unsigned int end) {
        const auto   cell      = moved<dim>(place.face, axis, static_cast<int>(end) - 1);
        const double volume    = value_at(transfer.before[end][axis], place);
        const int    component = component_at(open, axis, place, end);
        if (volume == 0) // beyond the domain
          return typename DualTransfer<dim>::Amount{0., 0.};
        const double amount =
          value_at(amounts, cell, component) * volume / value_at(volumes, cell, component);
        return typename DualTransfer<dim>::Amount{staying * amount, (1 - staying) * amount};
      }));
  }


  template <int dim>
  void
  compare_axes(const bool periodic, const double staying)
  {
    INFO(dim << "D, periodic " << periodic << ", staying " << staying);
    const BallAndSheet<dim> scene(periodic_axes<dim>(periodic));
    const DualTransfer<dim> transfer(
      scene.grid(), scene.before.parts.open, scene.after.parts.open, scene.vicinity);
    const auto along_first = after_transfer(scene, transfer, 0, staying);
    CHECK(total(along_first) == Approx(total(contents(scene))).epsilon(1e-12));
    for (unsigned int axis = 1; axis < dim; ++axis)
      {
        const auto along = after_transfer(scene, transfer, axis, staying);
        double     worst = 0;
        for_each_cell_place(along, [&](const PressurePlace<dim> &place) {
          worst = std::max(worst, std::abs(value_at(along, place) - value_at(along_first, place)));
        });
        CHECK(worst < 1e-12);
      }
  }
} // namespace


TEST_CASE("What dual volumes hold goes where components go, along every axis alike", "[mpi]")
{
  for (const bool periodic : {false, true})
    for (const double staying : {1., .3})
      {
        compare_axes<2>(periodic, staying);
        compare_axes<3>(periodic, staying);
      }
}
