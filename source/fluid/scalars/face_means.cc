// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/advection/advection.h>
#include <undine/fluid/grid/field_algebra.h>
#include <undine/fluid/grid/interpolation.h>
#include <undine/fluid/scalars/face_means.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace undine
{
  namespace
  {
    constexpr double no_mean        = std::numeric_limits<double>::quiet_NaN();
    constexpr double cells_rounding = 1e-6; ///< lest it decide, in cells


    /// How many cells there are between the ends of a path.
    template <int dim>
    double
    distance_in_cells(const MacGrid<dim>       &grid,
                      const dealii::Point<dim> &place,
                      const dealii::Point<dim> &foot)
    {
      double result = 0;
      for (unsigned int d = 0; d < dim; ++d)
        {
          const auto begin = grid.faces(d)->row(d).locate(place[d]);
          const auto end   = grid.faces(d)->row(d).locate(foot[d]);
          result = std::max(result, std::abs(begin.lower - end.lower + begin.weight - end.weight));
        }
      return result;
    }


    /// At one face; a path that an inflow cuts short may have been `longest` cells long, and has
    /// brought what came in when it did, changed by `rate` since.
    template <int dim>
    double
    mean_at(const CharacteristicTracer<dim> &tracer,
            const BoundaryCondition<dim>    &condition,
            const Field<dim>                &source,
            const dealii::Point<dim>        &place,
            const double                     rate,
            const int                        longest)
    {
      const auto   middle = tracer.trace(place, -tracer.dt() / 2);
      const double known  = 2 * distance_in_cells(tracer.model().grid(), place, middle.foot.point);
      const double cells  = middle.left_domain ? std::max<double>(longest, known) : known;
      const int    n      = std::max(1, static_cast<int>(std::ceil(cells - cells_rounding)));
      double       sum    = 0;
      for (int k = 0; k < n; ++k)
        {
          const double since = (k + .5) / n * tracer.dt();
          const auto   trace = n == 1 ? middle : tracer.trace(place, -since);
          if (trace.near_body)
            return no_mean;
          const double entry   = tracer.time() + since - trace.inside;
          const auto   entered = trace.left_domain
                                   ? entering_value(tracer, trace, source, condition, entry)
                                   : std::nullopt;
          // `source` has half of the change in the stage.
          const double value = entered
                                 ? *entered + trace.inside * rate
                                 : interpolate_cubic(source, trace.foot.point, Overshoot::kept) +
                                     (since - tracer.dt() / 2) * rate;
          sum += value / n;
        }
      return sum;
    }


    /// The difference of bounds that may be neglected. Collective.
    template <int dim>
    double
    negligible(const ScalarFluxes<dim> &fluxes, const ScalarBounds<dim> &bounds)
    {
      double least = std::numeric_limits<double>::max(), most = -least;
      for_each_cell_place(bounds.lower, [&](const PressurePlace<dim> &place) {
        least = std::min(least, value_at(bounds.lower, place));
        most  = std::max(most, value_at(bounds.upper, place));
      });
      const auto communicator = fluxes.flow.model().grid().communicator();
      return fluxes.condition.neglected_variation() *
             (dealii::Utilities::MPI::max(most, communicator) -
              dealii::Utilities::MPI::min(least, communicator));
    }
  } // namespace


  template <int dim>
  Velocity<dim>
  face_means(const ScalarFluxes<dim> &fluxes,
             const Field<dim>        &begin,
             const Field<dim>        &half,
             ScalarBounds<dim>       &bounds)
  {
    const auto &flow   = fluxes.flow;
    const auto &tracer = flow.paths();
    const auto &grid   = flow.model().grid();
    // The feet of paths are at the begin of the stage: there `half` has what came in until then,
    // gone on as all has.
    Field<dim> rate(half.shared_lattice(), half.topology());
    add(rate, 2 / tracer.dt(), half);
    add(rate, -2 / tracer.dt(), begin);
    const auto source = completed(tracer,
                                  std::vector<Field<dim>>(1, half),
                                  {{tracer.time() + tracer.dt() / 2}, &rate},
                                  fluxes.condition,
                                  Extension::linear)
                          .front();
    const double neglect  = negligible(fluxes, bounds);
    const auto   is_fixed = [&](const GridIndex<dim> &cell) {
      return bounds.upper(cell) - bounds.lower(cell) <= neglect;
    };
    bounds.lower.exchange(1);
    bounds.upper.exchange(1);
    Velocity<dim> result;
    for (unsigned int axis = 0; axis < dim; ++axis)
      {
        auto &means = result[axis] = Field<dim>(grid.faces(axis), flow.topology());
        std::fill(means.parts().begin(), means.parts().end(), no_mean);
        for_each(means.owned(), [&](const GridIndex<dim> &face) {
          const auto below = moved<dim>(face, axis, -1);
          if (!is_whole(means.divided(), face))
            means(face) = no_mean;
          else if (!grid.at_boundary(axis, face) && is_fixed(below) && is_fixed(face))
            means(face) = (half(below) + half(face)) / 2;
          else
            {
              const auto &inside = grid.cells()->owned().contains(face) ? face : below;
              means(face)        = mean_at(tracer,
                                    fluxes.condition,
                                    source,
                                    means.lattice().point(face),
                                    rate(inside),
                                    bounds.reached_by_flow);
            }
        });
      }
    exchange(result);
    return result;
  }


  template Velocity<2>
  face_means(const ScalarFluxes<2> &, const Field<2> &, const Field<2> &, ScalarBounds<2> &);
  template Velocity<3>
  face_means(const ScalarFluxes<3> &, const Field<3> &, const Field<3> &, ScalarBounds<3> &);
} // namespace undine
