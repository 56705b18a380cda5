// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/operators/outside_forces.h>
#include <undine/operators/outside_points.h>


namespace undine
{
  namespace
  {
    /// That of the opening on one of the sides that the point is beyond [Pa]; zero without one.
    template <int dim>
    double
    pressure_at(const BoundaryMap<dim>       &boundaries,
                const OutsidePoint<dim>      &point,
                const dealii::Tensor<1, dim> &weight,
                const double                  time)
    {
      for (const auto &side : point.sides)
        if (const auto &boundary = boundaries.at(side, point.nearest); boundary.is_open())
          return boundary.pressure.value(point.nearest, time) + weight * point.nearest;
      return 0;
    }
  } // namespace


  template <int dim>
  std::vector<dealii::Tensor<1, dim>>
  outside_forces(const BoundaryMap<dim>                &boundaries,
                 const Surface<dim>                    &surface,
                 const std::vector<dealii::Point<dim>> &positions,
                 const dealii::Tensor<1, dim>          &weight,
                 const double                           time)
  {
    std::vector<dealii::Tensor<1, dim>> forces(surface.n_nodes());
    if (boundaries.has_opening())
      for_each_point_outside(boundaries.grid(),
                             surface,
                             positions,
                             surface.n_nodes(),
                             [&](const OutsidePoint<dim> &point) {
                               const auto force =
                                 pressure_at(boundaries, point, weight, time) * point.into_body;
                               for (unsigned int i = 0; i < dim; ++i)
                                 forces[point.facet[i]] += point.shape[i] * force;
                             });
    return forces;
  }


  template <int dim>
  std::vector<double>
  outside_pressures_on_facets(const BoundaryMap<dim>                &boundaries,
                              const Surface<dim>                    &surface,
                              const std::vector<dealii::Point<dim>> &positions,
                              const dealii::Tensor<1, dim>          &weight,
                              const double                           time)
  {
    std::vector<double> result(surface.facets().size() * dim);
    if (boundaries.has_opening())
      for_each_point_outside(boundaries.grid(),
                             surface,
                             positions,
                             surface.n_nodes(),
                             [&](const OutsidePoint<dim> &point) {
                               const unsigned int facet = &point.facet - surface.facets().data();
                               const auto         whole = area_vector(surface, facet, positions);
                               if (whole.norm_square() == 0)
                                 return;
                               const double of_whole =
                                 pressure_at(boundaries, point, weight, time) *
                                 (point.into_body * whole) / whole.norm_square();
                               for (unsigned int k = 0; k < dim; ++k)
                                 result[facet * dim + k] += point.shape[k] * of_whole;
                             });
    return result;
  }


  template <int dim>
  double
  work_outside(const BoundaryMap<dim>                &boundaries,
               const Surface<dim>                    &surface,
               const std::vector<dealii::Point<dim>> &positions,
               const unsigned int                     n_nodes,
               const dealii::Tensor<1, dim>          &weight,
               const double                           time)
  {
    double work = 0;
    if (boundaries.has_opening())
      for_each_point_outside(
        boundaries.grid(), surface, positions, n_nodes, [&](const OutsidePoint<dim> &point) {
          work -= point.height() * pressure_at(boundaries, point, weight, time) *
                  point.into_body[point.sides.front().axis];
        });
    return work;
  }


#define INSTANTIATE(dim)                                                \
  template std::vector<dealii::Tensor<1, dim>> outside_forces(          \
    const BoundaryMap<dim> &,                                           \
    const Surface<dim> &,                                               \
    const std::vector<dealii::Point<dim>> &,                            \
    const dealii::Tensor<1, dim> &,                                     \
    double);                                                            \
  template std::vector<double> outside_pressures_on_facets(             \
    const BoundaryMap<dim> &,                                           \
    const Surface<dim> &,                                               \
    const std::vector<dealii::Point<dim>> &,                            \
    const dealii::Tensor<1, dim> &,                                     \
    double);                                                            \
  template double work_outside(const BoundaryMap<dim> &,                \
                               const Surface<dim> &,                    \
                               const std::vector<dealii::Point<dim>> &, \
                               unsigned int,                            \
                               const dealii::Tensor<1, dim> &,          \
                               double);

  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace undine
