// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/grid/field_algebra.h>
#include <undine/fluid/pressure/backflow_stabilisation.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace undine
{
  namespace
  {
    /// a [m^(dim-1)] and V [m^dim] of a face or piece.
    struct Extent
    {
      double area, volume;
    };


    template <int dim>
    Extent
    extent(const MacGrid<dim> &grid, const FluidTopology<dim> *open, const OpenFace<dim> &opening)
    {
      const unsigned int axis = opening.side.axis;
      if (opening.piece < 0)
        return {grid.face_area(axis, opening.face), grid.dual_volume(axis, opening.face)};
      return {open->faces[axis].all()[opening.piece].measure,
              open->pieces[axis][opening.piece].volume};
    }


    /// The velocity on an opening; `velocity` const or not.
    template <class AnyVelocity, int dim>
    decltype(auto)
    value_on(AnyVelocity &velocity, const OpenFace<dim> &opening)
    {
      auto &component = velocity[opening.side.axis];
      return opening.piece < 0 ? component(opening.face) : component.parts()[opening.piece];
    }
  } // namespace


  template <int dim>
  void
  stabilise_backflow(Velocity<dim>              &velocity,
                     std::vector<OpenFace<dim>> &openings,
                     const FluidModel<dim>      &model,
                     const double                dt)
  {
    for (auto &opening : openings)
      if (opening.kind == BoundaryKind::outflow)
        {
          const double s    = opening.entering;
          const auto   size = extent(model.grid(), velocity.topology(), opening);
          opening.mobility  = 1 / (1 + dt * s * size.area / size.volume);
          opening.pressure  = opening.outside + model.density() / 2 * s * s;
          value_on(velocity, opening) *= opening.mobility;
        }
    set_means(velocity, model.grid());
  }


  template <int dim>
  double
  update_entering_speeds(std::vector<OpenFace<dim>> &openings,
                         const Velocity<dim>        &velocity,
                         const FluidModel<dim>      &model,
                         const double                dt)
  {
    double largest = 0;
    for (auto &opening : openings)
      if (opening.kind == BoundaryKind::outflow)
        {
          const auto   size = extent(model.grid(), velocity.topology(), opening);
          const double u    = -opening.side.sign() * value_on(velocity, opening);
          const double now  = std::max(0., u);
          const double miss = now - opening.entering;
          largest =
            std::max(largest, opening.mobility * dt * size.area / (2 * size.volume) * miss * miss);
          opening.pressure -= model.density() * opening.entering * u;
          opening.entering = now;
        }
    return dealii::Utilities::MPI::max(largest, model.grid().communicator());
  }


  template <int dim>
  BackflowMatrix::BackflowMatrix(const dealii::TrilinosWrappers::SparseMatrix &matrix_,
                                 const FluidModel<dim>                        &model,
                                 const PressureNumbers<dim>                   &numbers,
                                 const std::vector<OpenFace<dim>>             &openings)
    : matrix(matrix_)
  {
    const auto *open = numbers.topology().get();
    for (const auto &opening : openings)
      if (opening.mobility < 1)
        {
          const auto size     = extent(model.grid(), open, opening);
          const auto coupling = size.area * size.area / (model.density() * size.volume);
          removed.emplace_back(
            numbers.owned().index_within_set(numbers.of(place_inside(open, opening))),
            (1 - opening.mobility) * coupling);
        }
  }


  void
  BackflowMatrix::vmult(Vector &product, const Vector &pressure) const
  {
    matrix.vmult(product, pressure);
    for (const auto &[row, value] : removed)
      product.begin()[row] -= value * pressure.begin()[row];
  }


#define INSTANTIATE(dim)                                                                         \
  template void stabilise_backflow(                                                              \
    Velocity<dim> &, std::vector<OpenFace<dim>> &, const FluidModel<dim> &, const double);       \
  template double update_entering_speeds(                                                        \
    std::vector<OpenFace<dim>> &, const Velocity<dim> &, const FluidModel<dim> &, const double); \
  template BackflowMatrix::BackflowMatrix(const dealii::TrilinosWrappers::SparseMatrix &,        \
                                          const FluidModel<dim> &,                               \
                                          const PressureNumbers<dim> &,                          \
                                          const std::vector<OpenFace<dim>> &);

  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace undine
