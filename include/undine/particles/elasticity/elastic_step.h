// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_particles_elasticity_elastic_step_h
#define undine_particles_elasticity_elastic_step_h

#include <undine/particles/elasticity/body_sums.h>
#include <undine/particles/elasticity/contact.h>
#include <undine/particles/elasticity/elastic_bodies.h>
#include <undine/particles/elasticity/explicit_steps.h>
#include <undine/particles/elasticity/implicit_elasticity.h>
#include <undine/particles/execution/sums.h>
#include <undine/particles/model/body_force.h>

namespace undine::particles
{
  /// What a run of ElasticStep is for.
  enum class ElasticRun
  {
    alone,   ///< no fluid: all of elasticity
    attempt, ///< without the fluid's pressure; tells the pressure equation where bodies want to go
    final    ///< again from the same start, with the acceleration by pressures kept constant
  };

  /// Takes the elastic bodies over a sub-step, all in one launch: in smaller explicit steps
  /// (symplectic Euler), or in one of backward Euler if those would be too many.
  template <int dim, class Real>
  struct ElasticStep
  {
    ElasticRun                 purpose;
    Elasticity<dim, Real>      elasticity;
    Contact<dim, Real>         contact;
    BodyForce<dim, Real>       force;
    Real                       displaced_density; ///< of Constants [kg/m^3]
    bool                       is_closed;         ///< of Constants
    Real                       top_potential;     ///< of Constants [J/kg]
    Vector<dim, Real>         *x_start;           ///< [m]
    const Vector<dim, Real>   *v_start;           ///< [m/s]
    ElasticPoint<dim, Real>   *points_next;       ///< while others still read the points
    ImplicitVectors<dim, Real> implicit_vectors;
    const Vector<dim, Real>   *pressure_accelerations; ///< [m/s^2]
    Real                      *carried;                ///< of ElasticBodies [Pa]
    Real                       carry_share;            ///< of the difference, in a sub-step [1]
    Place<dim, Real>          *places; ///< of the sorted particles; receives the result
    Motion<dim, Real>         *motions;
    StepBounds                 bounds;
    StepControl               *control;

    using Response = typename Contact<dim, Real>::Response;

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
      if (team.is_first())
        count(steps);
      team.for_each(n, [&](const int i) { end(i, now.bodies().points[i]); });
      carry_pressure(team);
    }

    /// Would it take too many explicit steps?
    UNDINE_HOST_DEVICE
    bool
    is_stiff() const
    {
      return bounds.most_elastic_steps > 0 &&
             ExplicitSteps(control->dt, bounds).number(0) > bounds.most_elastic_steps;
    }

    /// Where and how fast a particle starts.
    UNDINE_HOST_DEVICE
    ElasticPoint<dim, Real>
    start_of(const int i) const
    {
      return {purpose == ElasticRun::final ? x_start[i] : elasticity.bodies.points[i].x,
              v_start[i]};
    }

    /// Symplectic Euler.
    UNDINE_HOST_DEVICE
    static ElasticPoint<dim, Real>
    moved(const ElasticPoint<dim, Real> &point,
          const unsigned char            held,
          const Real                     h,
          const Vector<dim, Real>       &a)
    {
      const auto v = free_part(point.v + h * a, held);
      return {point.x + h * v, v};
    }

    /// By the body force; in a full domain what is left after the displaced fluid has been borne
    /// [m/s^2].
    UNDINE_HOST_DEVICE
    Vector<dim, Real>
    body_force(const ElasticMaterial<Real> &material, const Vector<dim, Real> &x) const
    {
      return (1 - displaced_density / material.density) * force.acceleration(x);
    }

    /// By damping of the velocity itself (P15) [m/s^2].
    UNDINE_HOST_DEVICE
    static Vector<dim, Real>
    drag(const ElasticMaterial<Real> &material, const Vector<dim, Real> &v)
    {
      return -material.drag * v;
    }

    /// By the fluid's pressure [m/s^2].
    UNDINE_HOST_DEVICE
    Vector<dim, Real>
    pressure_acceleration(const int i) const
    {
      return purpose == ElasticRun::final ? pressure_accelerations[i] : Vector<dim, Real>::zero();
    }

    /// How fast the fastest waves, the hardest and the fastest contacts of a particle are, as in
    /// StepBounds [1/s]; 0: not faster than those of bodies at rest.
    UNDINE_HOST_DEVICE
    float
    rate_of(const ElasticMaterial<Real> &material,
            const Matrix<dim, Real>     &F,
            const Response              &contacts) const
    {
      const ElasticLaw<dim, Real> law{material};
      const Real                  spacing_square = elasticity.spacing * elasticity.spacing;
      const Real                  of_bonds       = hourglass_square(material);
      const Real                  square = (law.sound_square(F) + of_bonds) / spacing_square +
                          contacts.frequency_square / static_cast<Real>(lattice_frequency_square) +
                          contacts.closing_square * closing_factor * closing_factor;
      if (material.viscosity > 0 || material.drag > 0)
        {
          const Real rate =
            damped_rate(material, square, (law.strain_rate_square(F) + of_bonds) / spacing_square);
          return rate > static_cast<Real>(bounds.elastic_rate) ? static_cast<float>(rate) : 0.f;
        }
      return square > static_cast<Real>(bounds.elastic_rate * bounds.elastic_rate)
               ? static_cast<float>(square_root(square))
               : 0.f;
    }

    /// By one worker.
    UNDINE_HOST_DEVICE
    void
    count(const int steps) const
    {
      if (purpose != ElasticRun::attempt)
        control->elastic_steps_total += steps;
    }

    UNDINE_HOST_DEVICE
    void
    fail() const
    {
      atomic_or(&control->failures, static_cast<unsigned int>(Failure::crushed));
    }

    /// Hand over where a particle ends.
    UNDINE_HOST_DEVICE
    void
    end(const int i, const ElasticPoint<dim, Real> &point) const
    {
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
      atomic_maximum(&control->largest_speed, static_cast<float>(square_root(norm_square(v))));
    }

    /// Elasticity takes over the mean pressure of each body little by little: at once, bodies would
    /// swing with their own sound. What it carries beyond twice the pressure is given back
    /// `release` times as fast: after an impact it would squeeze on, and nothing would do that
    /// work. Nor is it more than what bears it already, U'(J), and the shear modulus: beyond that
    /// the surface of a body that has not been compressed so far folds.
    template <class Team>
    UNDINE_HOST_DEVICE
    void
    carry_pressure(Team &team) const
    {
      if (purpose != ElasticRun::final || !(carry_share > 0))
        return;
      team.sync(); // all particles are where they end
      const Real level = is_closed ? common_level(team) : Real(0);
      for_each_body_sum<4>(
        team,
        elasticity.bodies,
        [&](const int i, Sums<4> &add) {
          add[0] += motions[contact.where[i]].pressure;
          add[1] += pressure_at_rest(i);
          add[2] -= elasticity.volume_tension(i);
          add[3] += 1;
        },
        [&](const int body, const Sums<4> &sums) {
          const Real pressure = maximum(Real(0), static_cast<Real>(sums[0] / sums[3])) +
                                static_cast<Real>(sums[1] / sums[3]) - level;
          const Real borne = static_cast<Real>(sums[2] / sums[3]);
          const Real gone  = maximum(Real(0), carried[body] - maximum(pressure, 2 * pressure));
          carried[body] += carry_share * (pressure - carried[body]) -
                           minimum(release * carry_share, Real(1)) * gone;
          carried[body] =
            minimum(carried[body], maximum(Real(0), borne) + elasticity.bodies.materials[body].mu);
        });
    }

  private:
    /// What pressures lack in a full domain (P11) [Pa].
    UNDINE_HOST_DEVICE
    Real
    pressure_at_rest(const int i) const
    {
      return displaced_density * (top_potential - force.potential(elasticity.bodies.points[i].x));
    }

    /// Of the pressure at rest in a full domain, where it is known up to a constant: that at which
    /// bodies together keep their volume, as the fluid around them leaves no room and takes none;
    /// what motion adds to it is zero in the mean of the fluid (P12) [Pa].
    template <class Team>
    UNDINE_HOST_DEVICE
    Real
    common_level(Team &team) const
    {
      const auto sums = team.template sum<2>(elasticity.bodies.n, [&](const int i, Sums<2> &add) {
        const Real softness = elasticity.compressibility(i);
        add[0] += softness * pressure_at_rest(i);
        add[1] += softness;
      });
      return static_cast<Real>(sums[0] / sums[1]);
    }

    static constexpr Real release = 10;

    /// In a step two may come closer by elastic_share over this of their distance.
    static constexpr Real closing_factor = Real(4);

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
      const auto start   = start_of(i);
      x_start[i]         = start.x;
      bodies().points[i] = start;
    }

    /// Steps follow what the rate is at their beginning. Returns how many they were.
    template <class Team>
    UNDINE_HOST_DEVICE
    int
    move_explicitly(Team &team)
    {
      const int     n = bodies().n;
      ExplicitSteps steps(control->dt, bounds);
      while (steps.goes_on)
        {
          std::uint32_t *const measured = &control->elastic_rates[steps.taken % 2];
          std::uint32_t *const later    = &control->elastic_rates[(steps.taken + 1) % 2];
          contact.time_left             = static_cast<Real>(steps.left);
          team.for_each_by_lanes(n, [&](const int i, const auto &lanes) {
            elasticity.deform(i, lanes);
            measure_rate(i, lanes, measured);
          });
          team.sync();
          const Real h = static_cast<Real>(steps.next(number_of_bits(*measured)));
          team.for_each_by_lanes(n, [&](const int i, const auto &lanes) { move(i, h, lanes); });
          if (team.is_first())
            *later = 0;
          team.sync();
          swap();
        }
      if (steps.failed && team.is_first())
        fail();
      return steps.taken;
    }

    template <class Lanes>
    UNDINE_HOST_DEVICE
    void
    measure_rate(const int i, const Lanes &lanes, std::uint32_t *measured) const
    {
      const auto contacts = contact.response(i, lanes);
      if (lanes.rank() != 0)
        return;
      const auto &bodies = elasticity.bodies;
      const float rate =
        rate_of(bodies.materials[bodies.bodies[i]], bodies.deformations[i], contacts);
      if (rate > 0)
        atomic_maximum(measured, rate);
    }

    template <class Lanes>
    UNDINE_HOST_DEVICE
    void
    move(const int i, const Real h, const Lanes &lanes)
    {
      const auto point = bodies().points[i];
      const auto a     = acceleration(i, lanes);
      if (lanes.rank() == 0)
        points_next[i] = moved(point, elasticity.bodies.clamped[i], h, a);
    }

    /// One step of backward Euler; what pressures do is kept constant.
    template <class Team>
    UNDINE_HOST_DEVICE
    int
    move_implicitly(Team &team)
    {
      const int  n         = bodies().n;
      const Real h         = static_cast<Real>(control->dt);
      elasticity.is_damped = false;
      contact.time_left    = 0; // forces are those at the end
      team.for_each_by_lanes(n,
                             [&](const int i, const auto &lanes) { elasticity.deform(i, lanes); });
      team.sync();
      ImplicitElasticity<dim, Real>{elasticity, contact, implicit_vectors, h}.step(
        team, v_start, [&](const int i) { return acceleration(i, OneLane()); });
      team.sync();
      team.for_each(n, [&](const int i) {
        ElasticPoint<dim, Real> point = bodies().points[i];
        point.v = free_part(point.v + implicit_vectors.change[i], bodies().clamped[i]);
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
      auto result = body_force(elasticity.material(i), elasticity.bodies.points[i].x) +
                    pressure_acceleration(i);
      result += drag(elasticity.material(i), elasticity.bodies.points[i].v);
      result += contact.response(i, lanes).acceleration;
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
  };
} // namespace undine::particles

#endif
