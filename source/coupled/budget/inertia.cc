// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/coupled/budget/inertia.h>
#include <undine/solid/step/solid_columns.h>

#include <cmath>

namespace undine
{
  template <int dim>
  double
  inertia(const Models<dim> &models)
  {
    double     sum = 0;
    const auto add = [&sum](const double mass, const double volume) {
      sum += mass * std::pow(volume, 2. / dim);
    };
    if (models.fluid)
      {
        const auto extent = models.fluid->grid().upper() - models.fluid->grid().lower();
        double     volume = 1;
        for (unsigned int axis = 0; axis < dim; ++axis)
          volume *= extent[axis];
        add(models.fluid->density() * volume, volume);
      }
    if (models.solid)
      for (const auto &body : measure_bodies(*models.solid, models.solid->vector()))
        add(body.mass, body.volume);
    return sum;
  }


  template double
  inertia(const Models<2> &);
  template double
  inertia(const Models<3> &);
} // namespace undine
