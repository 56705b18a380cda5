// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_cutting_fragment_at_plane_h
#define undine_cutting_fragment_at_plane_h

#include <deal.II/base/array_view.h>
#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <vector>

namespace undine
{
  /// Where a fragment of the surface meets a plane of the grid: a point in 2D, a segment in 3D.
  template <int dim>
  struct PlaneChord
  {
    dealii::Point<dim>     middle; ///< [m]
    dealii::Tensor<1, dim> normal; ///< in the plane, of the chord's length, out of the fluid
                                   ///< [m^(dim-2)]
  };

  /// Given its ends, the axis normal to the plane and the fragment's normal out of the fluid. @{
  PlaneChord<2>
  plane_chord(const std::vector<dealii::Point<2>> &ends,
              const unsigned int                   axis,
              const dealii::Tensor<1, 2>          &fragment_normal);
  PlaneChord<3>
  plane_chord(const std::vector<dealii::Point<3>> &ends,
              const unsigned int                   axis,
              const dealii::Tensor<1, 3>          &fragment_normal);
  /// @}


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
