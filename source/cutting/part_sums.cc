// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/cutting/part_sums.h>

#include <algorithm>

namespace undine
{
  template <int dim>
  void
  PartSums<dim>::include(const dealii::Point<dim> &place)
  {
    if (empty)
      lower = upper = place;
    empty = false;
    for (unsigned int d = 0; d < dim; ++d)
      {
        lower[d] = std::min(lower[d], place[d]);
        upper[d] = std::max(upper[d], place[d]);
      }
  }


  template <int dim>
  void
  PartSums<dim>::add(const PartSums &other)
  {
    volume += other.volume;
    moment += other.moment;
    if (!other.empty)
      {
        include(other.lower);
        include(other.upper);
      }
  }


  template <int dim>
  dealii::Point<dim>
  PartSums<dim>::centroid() const
  {
    dealii::Point<dim> result;
    for (unsigned int d = 0; d < dim; ++d)
      result[d] = volume != 0 ? std::clamp(moment[d] / volume, lower[d], upper[d])
                              : (lower[d] + upper[d]) / 2;
    return result;
  }


  template struct PartSums<2>;
  template struct PartSums<3>;
} // namespace undine
