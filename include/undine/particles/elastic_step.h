// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_particles_elastic_step_h
#define undine_particles_elastic_step_h

#include <undine/particles/body_force.h>
#include <undine/particles/contact.h>
#include <undine/particles/elastic_bodies.h>
#include <undine/particles/implicit_elasticity.h>
#include <undine/particles/step_control.h>
#include <undine/particles/sums.h>

namespace undine::particles
{
  /// What a run of ElasticStep is for.
  enum class ElasticRun
  {
    alone,   ///< no fluid: all of elasticity, in explicit steps
    attempt, ///< without the fluid's pressure; tells the pressure equation where bodies want to go
    final    ///< again from the same start, with the acceleration by pressures held constant
  };

  /// Takes the elastic bodies over a sub-step in smaller explicit steps (symplectic Euler), all in
  /// one launch.
  template <int dim, class Real>
  struct ElasticStep
  {
    ElasticRun                 purpose;
    Elasticity<dim, Real>      elasticity;
    Contact<dim, Real>         contact;
    BodyForce<dim, Real>       force;
    Vector<dim, Real>         *x_start;     ///< [m]
    const Vector<dim, Real>   *v_start;     ///< [m/s]
    ElasticPoint<dim, Real>   *points_next; ///< while others still read the points
    ImplicitVectors<dim, Real> implicit_vectors;
    const Vector<dim, Real>   *pressure_accelerations; ///< [m/s^2]
    int                        n_bodies;
    Real                      *carried;     ///< of ElasticBodies [Pa]
    Real                       carry_share; ///< of the difference, in a sub-step [1]
    Place<dim, Real>          *places;      ///< of the sorted particles; receives the result
    Motion<dim, Real>         *motions;
    StepBounds                 bounds;
    StepControl               *control;

    template <class Team>
    UNDINE_HOST_DEVICE
    void
    operator()(Team &team) const
    {
      if (control->done())
        return;
      ElasticStep now = *this; // its points and points_next change places
      const int   n   = elasticity.bodies.n;
      team.for_each_by_lanes(n, [&](const int i, const auto &lanes) { now.begin(i, lanes); });
      if (team.is_first())
        control->elastic_rates[0] = control->elastic_rates[1] = 0;
      team.sync();
      const int steps = is_stiff() ? now.move_implicitly(team) : now.move_explicitly(team);
      if (team.is_first() && purpose != ElasticRun::attempt)
        control->elastic_steps_total += steps;
      team.for_each(n, [&](const int i) { end(i, now); });
      if (purpose == ElasticRun::final && carry_share > 0)
        carry_pressure(team);
    }

  private:
    /// Would it take too many explicit steps?
    UNDINE_HOST_DEVICE
    bool
    is_stiff() const
    {
      return bounds.most_elastic_steps > 0 &&
             number_of_steps(control->dt, bounds.elastic_rate) > bounds.most_elastic_steps;
    }

    /// Explicit steps in `time` [s].
    UNDINE_HOST_DEVICE
    int
    number_of_steps(const double time, const double rate) const
    {
      return static_cast<int>(minimum(maximum(ceil(time * rate / bounds.elastic_share), 1.), 1e5));
    }

    /// Steps follow what the rate is at their beginning. Returns how many they were.
    template <class Team>
    UNDINE_HOST_DEVICE
    int
    move_explicitly(Team &team)
    {
      const int n    = bodies().n;
      const int most = 100 * number_of_steps(control->dt, bounds.elastic_rate);
      double    left = control->dt;
      for (int step = 0;; ++step)
        {
          std::uint32_t *const measured = &control->elastic_rates[step % 2];
          team.for_each_by_lanes(n, [&](const int i, const auto &lanes) {
            elasticity.deform(i, lanes);
            measure_rate(i, lanes, measured);
          });
          team.sync();
          const double rate =
            maximum(bounds.elastic_rate, static_cast<double>(number_of_bits(*measured)));
          const int  steps = number_of_steps(left, rate);
          const Real h     = static_cast<Real>(left / steps);
          team.for_each_by_lanes(n, [&](const int i, const auto &lanes) { move(i, h, lanes); });
          if (team.is_first())
            control->elastic_rates[(step + 1) % 2] = 0;
          team.sync();
          swap();
          if (steps == 1)
            return step + 1;
          if (step == most)
            {
              if (team.is_first())
                atomic_or(&control->failures, static_cast<unsigned int>(Failure::crushed));
              return most;
            }
          left -= left / steps;
        }
    }

    /// How far the fastest waves, the hardest and the fastest contacts are from those of bodies at
    /// rest.
    template <class Lanes>
    UNDINE_HOST_DEVICE
    void
    measure_rate(const int i, const Lanes &lanes, std::uint32_t *measured) const
    {
      const auto contacts = contact.rate_squares(i, lanes);
      if (lanes.rank() != 0)
        return;
      const Real square = elasticity.sound_square(i) / (elasticity.spacing * elasticity.spacing) +
                          contacts[0] / lattice_frequency_square +
                          contacts[1] * closing_factor * closing_factor;
      if (square > static_cast<Real>(bounds.elastic_rate * bounds.elastic_rate))
        atomic_maximum(measured, static_cast<float>(sqrt(square)));
    }

    /// Square of the highest frequency of a lattice of particles over c_p / l0: explicit steps are
    /// stable up to about 0.95 l0 / c_p.
    static constexpr Real lattice_frequency_square = Real(4.4);

    /// In a step two may come closer by elastic_share over this of their distance.
    static constexpr Real closing_factor = Real(4);

    /// Elasticity takes over the mean pressure of each body little by little: at once, bodies would
    /// swing with their own sound. What it carries beyond twice the pressure is given back
    /// `release` times as fast: after an impact it would squeeze on, and nothing would do that
    /// work.
    template <class Team>
    UNDINE_HOST_DEVICE
    void
    carry_pressure(Team &team) const
    {
      for (int body = 0; body < n_bodies; ++body)
        {
          const auto sums =
            team.template sum<2>(elasticity.bodies.n, [&](const int i, Sums<2> &add) {
              if (elasticity.bodies.bodies[i] != body)
                return;
              add[0] += motions[contact.where[i]].pressure;
              add[1] += 1;
            });
          if (team.is_first())
            {
              const Real pressure = static_cast<Real>(sums[0] / sums[1]);
              const Real gone     = maximum(Real(0), carried[body] - 2 * pressure);
              carried[body] += carry_share * (pressure - carried[body]) -
                               minimum(release * carry_share, Real(1)) * gone;
            }
        }
    }

    static constexpr Real release = 10;

    UNDINE_HOST_DEVICE
    ElasticBodies<dim, Real> &
    bodies()
    {
      return elasticity.bodies;
    }

    template <class Lanes>
    UNDINE_HOST_DEVICE
    void
    begin(const int i, const Lanes &lanes)
    {
      contact.list_partners(i, lanes);
      if (lanes.rank() != 0)
        return;
      if (purpose == ElasticRun::final)
        bodies().points[i].x = x_start[i];
      else
        x_start[i] = bodies().points[i].x;
      bodies().points[i].v = v_start[i];
    }

    template <class Lanes>
    UNDINE_HOST_DEVICE
    void
    move(const int i, const Real h, const Lanes &lanes)
    {
      ElasticPoint<dim, Real> point = bodies().points[i];
      const auto              a     = acceleration(i, lanes);
      if (lanes.rank() != 0)
        return;
      point.v = bodies().held[i] ? Vector<dim, Real>::zero() : point.v + h * a;
      point.x += h * point.v;
      points_next[i] = point;
    }

    /// One step of backward Euler; what contacts and pressures do is held constant.
    template <class Team>
    UNDINE_HOST_DEVICE
    int
    move_implicitly(Team &team)
    {
      const int  n         = bodies().n;
      const Real h         = static_cast<Real>(control->dt);
      elasticity.is_damped = false;
      team.for_each_by_lanes(n,
                             [&](const int i, const auto &lanes) { elasticity.deform(i, lanes); });
      team.sync();
      ImplicitElasticity<dim, Real>{elasticity, implicit_vectors, h}.step(
        team, v_start, [&](const int i) { return acceleration(i, OneLane()); });
      team.sync();
      team.for_each(n, [&](const int i) {
        ElasticPoint<dim, Real> point = bodies().points[i];
        point.v =
          bodies().held[i] ? Vector<dim, Real>::zero() : point.v + implicit_vectors.change[i];
        point.x += h * point.v;
        points_next[i] = point;
      });
      team.sync();
      swap();
      return 1;
    }

    template <class Lanes>
    UNDINE_HOST_DEVICE
    Vector<dim, Real>
    acceleration(const int i, const Lanes &lanes) const
    {
      auto result = force.acceleration(elasticity.bodies.points[i].x);
      if (purpose == ElasticRun::final)
        result += pressure_accelerations[i];
      result += contact.acceleration(i, lanes);
      return result += elasticity.acceleration(i, lanes);
    }

    UNDINE_HOST_DEVICE
    void
    swap()
    {
      auto *const last = bodies().points;
      bodies().points = contact.bodies.points = points_next;
      points_next                             = last;
    }

    /// `now` knows where the last points are.
    UNDINE_HOST_DEVICE
    void
    end(const int i, ElasticStep &now) const
    {
      const auto point = now.bodies().points[i];
      const auto x = point.x, v = point.v;
      const int  slot = contact.where[i];
      places[slot].x  = elasticity.grid.wrapped(x);
      if (!elasticity.grid.contains(places[slot].x))
        atomic_or(&control->failures, static_cast<unsigned int>(Failure::outside));
      if (purpose == ElasticRun::attempt)
        {
          // The mean velocity: what matters to the fluid is how far the surface comes, not in which
          // phase of an unresolved vibration it arrives.
          motions[slot].v = static_cast<Real>(1 / control->dt) * (x - x_start[i]);
          return;
        }
      motions[slot].v             = v;
      elasticity.bodies.points[i] = point;
      atomic_maximum(&control->largest_speed, static_cast<float>(sqrt(norm_square(v))));
    }
  };
} // namespace undine::particles

#endif
