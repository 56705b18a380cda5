// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_fluid_visibility_openings_h
#define undine_fluid_visibility_openings_h

#include <undine/fluid/visibility/body_vicinity.h>

#include <cstddef>
#include <vector>

namespace undine
{
  /// Fluid in a cell or on a face: all of it, one component or one piece.
  template <int dim>
  struct Opening
  {
    int                               part; ///< -1: the cell or face is whole
    typename BodyVicinity<dim>::Place centre;
    double                            measure; ///< [m^dim] or [m^(dim-1)]
  };

  /// That one opening becomes another one, or a share of it does.
  struct Succession
  {
    std::size_t before, now; ///< numbers in the lists
    double      share;       ///< of what is in the one before [1]
  };

  /// What has become of the openings of a cell or a face, of the measure `whole`, as surfaces have
  /// moved. Each one now comes from the nearest one before on its side of the surfaces; of several
  /// that come from the same one each has a share in proportion to its measure. One before that
  /// none comes from becomes the nearest one now. Equally near ones count alike, so that mirror
  /// images have the same fate. One that has been covered becomes nothing.
  template <int dim>
  std::vector<Succession>
  successions(const std::vector<Opening<dim>> &before,
              const std::vector<Opening<dim>> &now,
              const double                     whole,
              const BodyVicinity<dim>         &vicinity);
} // namespace undine

#endif
