// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_particles_elasticity_body_sums_h
#define undine_particles_elasticity_body_sums_h

#include <undine/particles/elasticity/elastic_state.h>
#include <undine/particles/execution/sums.h>

namespace undine::particles
{
  /// take(body, sums) with the sums that add(i, sums) adds to over the particles i of each body. Of
  /// few bodies all workers together sum one after the other; of many each is left to some lanes,
  /// so that the work grows with the particles and not with their number times that of bodies. As
  /// sync() for the workers of few bodies; nobody waits after the last take().
  template <int count, int dim, class Real, class Team, class Add, class Take>
  UNDINE_HOST_DEVICE
  void
  for_each_body_sum(Team                           &team,
                    const ElasticBodies<dim, Real> &bodies,
                    const Add                      &add,
                    const Take                     &take)
  {
    constexpr int few = 16;
    if (bodies.n_bodies <= few)
      {
        for (int body = 0; body < bodies.n_bodies; ++body)
          {
            const auto sums = team.template sum<count>(bodies.n, [&](const int i, Sums<count> &to) {
              if (bodies.bodies[i] == body)
                add(i, to);
            });
            if (team.is_first())
              take(body, sums);
          }
        return;
      }
    team.for_each_by_lanes(bodies.n_bodies, [&](const int body, const auto &lanes) {
      Sums<count> sums;
      for (int k = bodies.starts[body] + lanes.rank(); k < bodies.starts[body + 1];
           k += lanes.count())
        add(bodies.members[k], sums);
      for (int k = 0; k < count; ++k)
        sums[k] = lanes.sum(sums[k]);
      if (lanes.rank() == 0)
        take(body, sums);
    });
  }
} // namespace undine::particles

#endif
