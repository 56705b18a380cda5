// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_particles_fluid_volume_error_h
#define undine_particles_fluid_volume_error_h

#include <undine/particles/execution/sums.h>
#include <undine/particles/fluid/neighbourhood.h>

namespace undine::particles
{
  /// Measures the error of the volume of all fluid, the mean of Neighbourhood::fillings - 1, where
  /// a full domain has openings through which what is missing can come in, and what is too much
  /// leave. The errors of single particles are left to EvenSpacing. One launch.
  template <int dim, class Real>
  struct MeasureVolumeError
  {
    int                     n;
    const Place<dim, Real> *places;
    const Real             *fillings;
    StepControl            *control;

    template <class Team>
    UNDINE_HOST_DEVICE
    void
    operator()(Team &team) const
    {
      if (control->done())
        return;
      const auto sums = team.template sum<2>(n, [&](const int i, Sums<2> &add) {
        const bool is_fluid = places[i].tag.kind() == Kind::fluid;
        add[0] += is_fluid ? static_cast<double>(fillings[i]) - 1 : 0.;
        add[1] += is_fluid ? 1 : 0;
      });
      if (team.is_first())
        control->volume_error = sums[1] > 0 ? sums[0] / sums[1] : 0;
    }
  };
} // namespace undine::particles

#endif
