// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_particles_elastic_step_h
#define undine_particles_elastic_step_h

#include <undine/particles/contact.h>
#include <undine/particles/elastic_bodies.h>
#include <undine/particles/step_control.h>

namespace undine::particles
{
  /// Takes the elastic bodies over a sub-step in smaller explicit steps (symplectic Euler), all in
  /// one launch. Runs twice in a sub-step: without the fluid's pressure, which tells the pressure
  /// equation where bodies want to go, and again from the same start with it, held constant.
  template <int dim, class Real>
  struct ElasticStep
  {
    Elasticity<dim, Real>    elasticity;
    Contact<dim, Real>       contact;
    Vector<dim, Real>        gravity;
    Vector<dim, Real>       *x_start;                ///< [m]
    const Vector<dim, Real> *v_start;                ///< [m/s]
    Vector<dim, Real>       *x_next, *v_next;        ///< while others still read x and v
    const Vector<dim, Real> *pressure_accelerations; ///< [m/s^2]; nullptr: the run without
    Place<dim, Real>        *places; ///< of the sorted particles; receives the result
    Motion<dim, Real>       *motions;
    StepControl             *control;

    template <class Team>
    UNDINE_HOST_DEVICE void
    operator()(Team &team) const
    {
      const int steps = control->elastic_steps;
      if (control->done() || steps == 0)
        return;
      const Real  h   = static_cast<Real>(control->dt / steps);
      ElasticStep now = *this; // its x, v and x_next, v_next change places
      const int   n   = now.bodies().n;
      team.for_each(n, [&](const int i) { now.begin(i); });
      team.sync();
      for (int step = 0; step < steps; ++step)
        {
          team.for_each(n, [&](const int i) { now.elasticity.deform(i); });
          team.sync();
          team.for_each(n, [&](const int i) { now.move(i, h); });
          team.sync();
          now.swap();
        }
      team.for_each(n, [&](const int i) { end(i, now); });
    }

  private:
    UNDINE_HOST_DEVICE ElasticBodies<dim, Real>                    &
    bodies()
    {
      return elasticity.bodies;
    }

    UNDINE_HOST_DEVICE void
    begin(const int i)
    {
      if (pressure_accelerations == nullptr)
        x_start[i] = bodies().x[i];
      else
        bodies().x[i] = x_start[i];
      bodies().v[i] = v_start[i];
    }

    UNDINE_HOST_DEVICE void
    move(const int i, const Real h)
    {
      auto v = Vector<dim, Real>::zero();
      if (!bodies().held[i])
        {
          auto acceleration = elasticity.acceleration(i) + contact.acceleration(i) + gravity;
          if (pressure_accelerations != nullptr)
            acceleration += pressure_accelerations[i];
          v = bodies().v[i] + h * acceleration;
        }
      v_next[i] = v;
      x_next[i] = bodies().x[i] + h * v;
    }

    UNDINE_HOST_DEVICE void
    swap()
    {
      auto *const x = bodies().x, *const v = bodies().v;
      bodies().x = contact.bodies.x = x_next;
      bodies().v = contact.bodies.v = v_next;
      x_next                        = x;
      v_next                        = v;
    }

    /// `now` knows where the last x and v are.
    UNDINE_HOST_DEVICE void
    end(const int i, ElasticStep &now) const
    {
      const auto x = now.bodies().x[i], v = now.bodies().v[i];
      const int  slot = contact.where[i];
      places[slot].x  = elasticity.grid.wrapped(x);
      motions[slot].v = v;
      if (pressure_accelerations == nullptr)
        return;
      elasticity.bodies.x[i] = x;
      elasticity.bodies.v[i] = v;
      atomic_maximum(&control->largest_speed, static_cast<float>(sqrt(norm_square(v))));
    }
  };
} // namespace undine::particles

#endif
