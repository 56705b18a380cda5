// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_cutting_fragment_half_h
#define undine_cutting_fragment_half_h

#include <deal.II/base/array_view.h>
#include <deal.II/base/point.h>

namespace undine
{
  /// The part of a fragment on one side of a plane x_axis = const.
  template <int dim>
  struct FragmentHalf
  {
    double             share = 0; ///< of the fragment's area
    dealii::Point<dim> centroid;  ///< [m]; not set if the share is 0
  };

  /// What of the segment or polygon with these corners, in their order, is above the plane at
  /// `position` [m], or below it. @{
  FragmentHalf<2>
  half_of_fragment(const dealii::ArrayView<const dealii::Point<2>> &corners,
                   const unsigned int                               axis,
                   const double                                     position,
                   const bool                                       is_upper);
  FragmentHalf<3>
  half_of_fragment(const dealii::ArrayView<const dealii::Point<3>> &corners,
                   const unsigned int                               axis,
                   const double                                     position,
                   const bool                                       is_upper);
  /// @}
} // namespace undine

#endif
