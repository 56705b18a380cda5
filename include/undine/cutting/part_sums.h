// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_cutting_part_sums_h
#define undine_cutting_part_sums_h

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

namespace undine
{
  /// Volume, first moments and extent of a part of a cell, relative to the cell's lower corner.
  template <int dim>
  struct PartSums
  {
    double                 volume = 0; ///< [m^dim]
    dealii::Tensor<1, dim> moment;     ///< integral of the coordinates [m^(dim+1)]
    dealii::Point<dim>     lower, upper;
    bool                   empty = true; ///< nothing has been included

    /// Enlarge the extent by a place [m].
    void
    include(const dealii::Point<dim> &place);

    /// Add the sums and the extent of another part.
    void
    add(const PartSums &other);

    /// [m], within the extent.
    dealii::Point<dim>
    centroid() const;
  };
} // namespace undine

#endif
