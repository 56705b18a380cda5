// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_coupled_immersed_measure_region_h
#define undine_coupled_immersed_measure_region_h

#include <undine/coupled/immersed/fluid_geometry.h>
#include <undine/coupled/model/models.h>
#include <undine/coupled/state/state.h>

#include <optional>
#include <vector>

namespace undine
{
  /// Of a region of fluid: all that one reaches from a place without crossing a body or an
  /// obstacle.
  struct RegionMeasures
  {
    double volume = 0; ///< now [m^dim]
    double inflow = 0; ///< through boundaries of the domain, in the step that led here [m^dim/s]
  };

  /// The region around `point` [m], between bodies at their positions in `state`. Cuts the grid.
  /// Collective. Throws SolveError if the point is not in the fluid.
  template <int dim>
  RegionMeasures
  measure_region(const Models<dim>        &models,
                 const State<dim>         &state,
                 const dealii::Point<dim> &point);

  /// The volumes of the regions around `points`, [points] [m^dim], between surfaces as `geometry`
  /// has them, or with their nodes at `positions` [m], for which the grid is cut once; nothing for
  /// points that are not in the fluid then. Collective. @{
  template <int dim>
  std::vector<std::optional<double>>
  region_volumes(const Models<dim>                     &models,
                 const FluidGeometry<dim>              &geometry,
                 const std::vector<dealii::Point<dim>> &points);
  template <int dim>
  std::vector<std::optional<double>>
  region_volumes(const Models<dim>                     &models,
                 const std::vector<dealii::Point<dim>> &positions,
                 const std::vector<dealii::Point<dim>> &points);
  /// @}
} // namespace undine

#endif
