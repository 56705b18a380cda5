// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_particles_measure_balance_h
#define undine_particles_measure_balance_h

#include <undine/particles/constants.h>
#include <undine/particles/elastic_bodies.h>
#include <undine/particles/step_control.h>
#include <undine/particles/sums.h>

namespace undine::particles
{
  /// Raises control->largest_speed to that of the free particles.
  template <int dim, class Real>
  struct MeasureSpeed
  {
    Particles<dim, Real> particles;
    StepControl         *control;

    UNDINE_HOST_DEVICE void
    operator()(const int i) const
    {
      if (particles.places[i].tag.is_free())
        atomic_maximum(&control->largest_speed,
                       static_cast<float>(sqrt(norm_square(particles.motions[i].v))));
    }
  };


  /// Kinetic energies of fluid and bodies [J], potential energy [J] and momentum [kg m/s], all in
  /// the plane per m of thickness.
  template <int dim, class Real>
  struct MeasureBalance
  {
    static constexpr int count = 3 + dim;

    Constants<dim, Real> constants;
    Particles<dim, Real> particles;
    Sums<count>         *result;

    template <class Team>
    UNDINE_HOST_DEVICE void
    operator()(Team &team) const
    {
      const auto sums = team.template sum<count>(particles.n, [&](const int i, Sums<count> &sums) {
        const auto place = particles.places[i];
        if (!place.tag.is_free())
          return;
        const double mass =
          static_cast<double>(constants.densities[place.tag.material()]) * constants.volume;
        const auto v      = particles.motions[i].v;
        double     square = 0, height = 0;
        for (int axis = 0; axis < dim; ++axis)
          {
            square += static_cast<double>(v[axis]) * v[axis];
            height -= static_cast<double>(constants.gravity[axis]) * place.x[axis];
            sums[3 + axis] += mass * v[axis];
          }
        sums[place.tag.kind() == Kind::fluid ? 0 : 1] += mass * square / 2;
        sums[2] += mass * height;
      });
      if (team.is_first())
        *result = sums;
    }
  };


  /// Elastic energy density, volume over that at rest, place and velocity, all summed over the
  /// particles of one body. Leaves deformations at the present places behind.
  template <int dim, class Real>
  struct MeasureBody
  {
    static constexpr int count = 2 + 2 * dim;

    Elasticity<dim, Real> elasticity;
    int                   body;
    Sums<count>          *result;

    template <class Team>
    UNDINE_HOST_DEVICE void
    operator()(Team &team) const
    {
      const auto &bodies = elasticity.bodies;
      team.for_each(bodies.n, [&](const int i) { elasticity.deform(i); });
      team.sync();
      const auto sums = team.template sum<count>(bodies.n, [&](const int i, Sums<count> &sums) {
        if (bodies.bodies[i] != body)
          return;
        sums[0] += elasticity.energy(i);
        sums[1] += determinant(bodies.deformations[i]);
        for (int axis = 0; axis < dim; ++axis)
          {
            sums[2 + axis] += bodies.x[i][axis];
            sums[2 + dim + axis] += bodies.v[i][axis];
          }
      });
      if (team.is_first())
        *result = sums;
    }
  };
} // namespace undine::particles

#endif
