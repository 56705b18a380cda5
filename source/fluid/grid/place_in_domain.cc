// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/grid/place_in_domain.h>

namespace undine
{
  template <int dim>
  void
  check_in_domain(const Options            &options,
                  const std::string        &key,
                  const dealii::Point<dim> &place,
                  const MacGrid<dim>       &grid)
  {
    for (unsigned int axis = 0; axis < dim; ++axis)
      if (!(place[axis] >= grid.lower()[axis] && place[axis] <= grid.upper()[axis]))
        throw options.error(key,
                            "the point (" + write_value(place) + ") is outside the domain",
                            "Allowed: from (" + write_value(grid.lower()) + ") to (" +
                              write_value(grid.upper()) + ") [m]");
  }


  template void
  check_in_domain(const Options &,
                  const std::string &,
                  const dealii::Point<2> &,
                  const MacGrid<2> &);
  template void
  check_in_domain(const Options &,
                  const std::string &,
                  const dealii::Point<3> &,
                  const MacGrid<3> &);
} // namespace undine
