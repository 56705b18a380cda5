// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/cutting/plane_chord.h>

namespace undine
{
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
} // namespace undine
