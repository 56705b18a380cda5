// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_coupled_immersed_chamber_h
#define undine_coupled_immersed_chamber_h

#include <undine/coupled/model/models.h>
#include <undine/coupled/state/state.h>

#include <optional>
#include <vector>

namespace undine
{
  /// A region of fluid: all that one reaches from a place without crossing a body or an obstacle.
  struct Chamber
  {
    double volume = 0; ///< now [m^dim]
    double inflow = 0; ///< through boundaries of the domain, in the step that led here [m^dim/s]
  };

  /// The chamber around `point` [m], between bodies at their positions in `state`. Cuts the grid.
  /// Collective. Throws SolveError if the point is not in the fluid.
  template <int dim>
  Chamber
  measure_chamber(const Models<dim>        &models,
                  const State<dim>         &state,
                  const dealii::Point<dim> &point);

  /// The volumes of the chambers around `points`, [points] [m^dim], for surfaces with their nodes
  /// at `positions` [m]; nothing for points that are not in the fluid then. Cuts the grid once.
  /// Collective.
  template <int dim>
  std::vector<std::optional<double>>
  chamber_volumes(const Models<dim>                     &models,
                  const std::vector<dealii::Point<dim>> &positions,
                  const std::vector<dealii::Point<dim>> &points);
} // namespace undine

#endif
