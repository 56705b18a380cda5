// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_coupled_step_misplacement_h
#define undine_coupled_step_misplacement_h

#include <undine/coupled/model/models.h>

#include <string>
#include <vector>

namespace undine
{
  /// How far from where the grid was cut a surface ends a stage, where that is farthest.
  struct Misplacement
  {
    double       cells = 0; ///< distance, in widths of the cell there [1]
    unsigned int node  = 0; ///< of the surface
  };

  /// Why a stage is given up whose surfaces, with nodes at `places` [m], were misplaced by `rounds`
  /// each time that it was solved: which body or obstacle, where, by how much, and what to try. A
  /// shorter step resolves a fast motion; a body that is no denser than the fluid may also shake
  /// because of the mass of the fluid that it has to accelerate, in short steps as in long ones.
  template <int dim>
  std::string
  misplacement_complaint(const Models<dim>                     &models,
                         const std::vector<dealii::Point<dim>> &places,
                         const std::vector<Misplacement>       &rounds);
} // namespace undine

#endif
