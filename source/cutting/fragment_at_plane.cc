// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/cutting/fragment_at_plane.h>

#include <boost/container/small_vector.hpp>

#include <utility>

namespace undine
{
  namespace
  {
    template <int dim>
    using Polygon = boost::container::small_vector<dealii::Point<dim>, 10>;


    /// The part of a closed polygon whose corners are at most `reach` [m] along an axis, times
    /// `sign`: by Sutherland and Hodgman (1974).
    template <int dim, class Corners>
    Polygon<dim>
    clipped(const Corners &corners, const unsigned int axis, const double sign, const double reach)
    {
      Polygon<dim>      result;
      const std::size_t n = corners.size();
      for (std::size_t k = 0; k < n; ++k)
        {
          const auto  &here = corners[k], &next = corners[(k + 1) % n];
          const double of_here = sign * here[axis] - reach, of_next = sign * next[axis] - reach;
          if (of_here <= 0)
            result.push_back(here);
          if ((of_here < 0 && of_next > 0) || (of_here > 0 && of_next < 0))
            result.push_back(here + of_here / (of_here - of_next) * (next - here));
        }
      return result;
    }


    /// Twice the area of a plane polygon and, weighted with that, the place of its centroid.
    template <class Corners>
    std::pair<double, dealii::Point<3>>
    area_and_moment(const Corners &corners)
    {
      dealii::Tensor<1, 3> sum, moment;
      double               area = 0;
      for (std::size_t k = 2; k < corners.size(); ++k)
        sum += dealii::cross_product_3d(corners[k - 1] - corners[0], corners[k] - corners[0]);
      const double size = sum.norm();
      for (std::size_t k = 2; k < corners.size() && size > 0; ++k)
        {
          const double part =
            dealii::cross_product_3d(corners[k - 1] - corners[0], corners[k] - corners[0]) * sum /
            size;
          area += part;
          moment += part / 3 *
                    (corners[0] + (corners[k - 1] - dealii::Point<3>()) +
                     (corners[k] - dealii::Point<3>()) - dealii::Point<3>());
        }
      return {area, dealii::Point<3>(moment)};
    }
  } // namespace


  PlaneChord<2>
  plane_chord(const std::vector<dealii::Point<2>> &ends,
              const unsigned int                   axis,
              const dealii::Tensor<1, 2>          &fragment_normal)
  {
    PlaneChord<2> chord{ends[0], {}};
    chord.normal[1 - axis] = fragment_normal[1 - axis] < 0 ? -1 : 1;
    return chord;
  }


  PlaneChord<3>
  plane_chord(const std::vector<dealii::Point<3>> &ends,
              const unsigned int                   axis,
              const dealii::Tensor<1, 3>          &fragment_normal)
  {
    dealii::Tensor<1, 3> direction;
    direction[axis] = 1;
    PlaneChord<3> chord{ends[0] + (ends[1] - ends[0]) / 2,
                        dealii::cross_product_3d(ends[1] - ends[0], direction)};
    if (chord.normal * fragment_normal < 0)
      chord.normal *= -1;
    return chord;
  }


  FragmentHalf<2>
  half_of_fragment(const dealii::ArrayView<const dealii::Point<2>> &corners,
                   const unsigned int                               axis,
                   const double                                     position,
                   const bool                                       is_upper)
  {
    const double    sign   = is_upper ? -1 : 1;
    const double    length = corners[0].distance(corners[1]);
    const double    start  = sign * (corners[0][axis] - position);
    const double    end    = sign * (corners[1][axis] - position);
    FragmentHalf<2> result;
    if (length == 0 || (start > 0 && end > 0))
      return result;
    const double from = start > 0 ? start / (start - end) : 0;
    const double to   = end > 0 ? start / (start - end) : 1;
    result.share      = to - from;
    result.centroid   = corners[0] + (from + to) / 2 * (corners[1] - corners[0]);
    return result;
  }


  FragmentHalf<3>
  half_of_fragment(const dealii::ArrayView<const dealii::Point<3>> &corners,
                   const unsigned int                               axis,
                   const double                                     position,
                   const bool                                       is_upper)
  {
    const double    sign = is_upper ? -1 : 1;
    const auto      part = area_and_moment(clipped<3>(corners, axis, sign, sign * position));
    const double    all  = area_and_moment(corners).first;
    FragmentHalf<3> result;
    if (!(all > 0) || !(part.first > 0))
      return result;
    result.share    = part.first / all;
    result.centroid = part.second / part.first;
    return result;
  }
} // namespace undine
