// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_particles_engine_measure_balance_h
#define undine_particles_engine_measure_balance_h

#include <undine/particles/elasticity/body_sums.h>
#include <undine/particles/elasticity/elastic_bodies.h>
#include <undine/particles/engine/engine.h>
#include <undine/particles/execution/buffer.h>
#include <undine/particles/execution/sums.h>
#include <undine/particles/fluid/fluid_in_bodies.h>
#include <undine/particles/model/constants.h>
#include <undine/particles/model/step_control.h>
#include <undine/particles/setup/make_constants.h>

namespace undine::particles
{
  /// Raises control->largest_speed to that of the free particles.
  template <int dim, class Real>
  struct MeasureSpeed
  {
    Particles<dim, Real> particles;
    StepControl         *control;

    UNDINE_HOST_DEVICE
    void
    operator()(const int i) const
    {
      if (particles.places[i].tag.is_free())
        atomic_maximum(&control->largest_speed,
                       static_cast<float>(square_root(norm_square(particles.motions[i].v))));
    }
  };


  /// Kinetic energies of fluid and bodies [J], potential energy [J], momentum [kg m/s] and mass
  /// [kg], all in the plane per m of thickness. In a full domain the potential energy is that of
  /// what bodies are heavier or lighter than the fluid in their place, as their body force is
  /// (P11): of the fluid nothing rises or sinks. With it that of a fluid which is compressed,
  /// p^2 / (2 K) per volume.
  template <int dim, class Real>
  struct MeasureBalance
  {
    static constexpr int count = 4 + dim;

    Constants<dim, Real> constants;
    Particles<dim, Real> particles;
    Sums<count>         *result;

    template <class Team>
    UNDINE_HOST_DEVICE
    void
    operator()(Team &team) const
    {
      const auto sums = team.template sum<count>(particles.n, [&](const int i, Sums<count> &sums) {
        const auto place = particles.places[i];
        if (!place.tag.is_free())
          return;
        const double mass   = static_cast<double>(constants.density(place.tag)) * constants.volume;
        const auto   v      = particles.motions[i].v;
        double       square = 0;
        for (int axis = 0; axis < dim; ++axis)
          {
            square += static_cast<double>(v[axis]) * v[axis];
            sums[3 + axis] += mass * v[axis];
          }
        sums[place.tag.kind() == Kind::fluid ? 0 : 1] += mass * square / 2;
        const double displaced =
          static_cast<double>(constants.displaced_density) * constants.volume;
        sums[2] += (mass - displaced) * constants.force.potential(place.x);
        const double pressure = particles.motions[i].pressure;
        if (place.tag.kind() == Kind::fluid)
          sums[2] += static_cast<double>(constants.fluid_compressibility) * pressure * pressure /
                     2 * constants.volume;
        sums[3 + dim] += mass;
      });
      if (team.is_first())
        *result = sums;
    }
  };


  /// Elasticity::deform() of a particle.
  template <int dim, class Real>
  struct DeformBodies
  {
    Elasticity<dim, Real> elasticity;

    UNDINE_HOST_DEVICE
    void
    operator()(const int i) const
    {
      elasticity.deform(i, OneLane());
    }
  };


  /// Volume over that at rest, density of elastic energy, place and velocity, all summed over the
  /// particles of each body, after deform() of all.
  template <int dim, class Real>
  struct MeasureBodies
  {
    static constexpr int count = 2 + 2 * dim;

    Elasticity<dim, Real> elasticity;
    Sums<count>          *results; ///< one a body

    template <class Team>
    UNDINE_HOST_DEVICE
    void
    operator()(Team &team) const
    {
      const auto &bodies = elasticity.bodies;
      for_each_body_sum<count>(
        team,
        bodies,
        [&](const int i, Sums<count> &sums) {
          sums[0] += determinant(bodies.deformations[i]);
          sums[1] += elasticity.energy_density(i);
          for (int axis = 0; axis < dim; ++axis)
            {
              sums[2 + axis] += bodies.points[i].x[axis];
              sums[2 + dim + axis] += bodies.points[i].v[axis];
            }
        },
        [&](const int body, const Sums<count> &sums) { results[body] = sums; });
    }
  };


  /// All of it, for the particles of a scene.
  template <class Executor, int dim, class Real>
  class BalanceSheet
  {
  public:
    BalanceSheet(Executor &executor, const Setup<dim> &setup)
      : executor(executor)
      , constants(make_constants<dim, Real>(setup))
      , body_sizes(setup.bodies.size())
    {
      for (const int body : setup.body_of)
        ++body_sizes[body];
    }

    Balance<dim>
    operator()(const Particles<dim, Real> &particles, const ElasticBodies<dim, Real> &bodies)
    {
      constants.bodies = bodies.materials;
      Balance<dim> result;
      const auto   sums =
        measured(MeasureBalance<dim, Real>{constants, particles, nullptr}, particles.n);
      result.kinetic_fluid = sums[0];
      result.kinetic_solid = sums[1];
      result.potential     = sums[2];
      result.mass          = sums[3 + dim];
      for (int axis = 0; axis < dim; ++axis)
        result.momentum[axis] = sums[3 + axis];
      Elasticity<dim, Real> elasticity{constants.grid, constants.spacing, constants.reach, bodies};
      elasticity.is_damped = false;
      executor.for_each(bodies.n, DeformBodies<dim, Real>{elasticity});
      add_bodies(result, elasticity);
      return result;
    }

    int
    count_fluid_in_bodies(const Neighbours<dim, Real> &neighbours, const int n)
    {
      if (body_sizes.empty())
        return 0;
      Buffer<Executor, int> count(executor, 1);
      executor.for_each(n, CountFluidInBodies<dim, Real>{constants, neighbours, count.data()});
      return count.values()[0];
    }

  private:
    void
    add_bodies(Balance<dim> &result, const Elasticity<dim, Real> &elasticity)
    {
      if (body_sizes.empty())
        return;
      using Measure = MeasureBodies<dim, Real>;
      Buffer<Executor, Sums<Measure::count>> measured(executor, body_sizes.size());
      executor.run(elasticity.bodies.n, Measure{elasticity, measured.data()});
      const auto all = measured.values();
      for (std::size_t b = 0; b < body_sizes.size(); ++b)
        {
          const auto         &sums  = all[b];
          const double        share = 1. / body_sizes[b];
          Vector<dim, double> centre, velocity;
          for (int axis = 0; axis < dim; ++axis)
            {
              centre[axis]   = share * sums[2 + axis];
              velocity[axis] = share * sums[2 + dim + axis];
            }
          result.elastic += constants.volume * sums[1];
          result.body_volumes.push_back(share * sums[0]);
          result.body_centres.push_back(centre);
          result.body_velocities.push_back(velocity);
        }
    }

    /// By a pass over n.
    template <class Measure>
    Sums<Measure::count>
    measured(Measure measure, const int n)
    {
      Buffer<Executor, Sums<Measure::count>> sums(executor, 1);
      measure.result = sums.data();
      executor.run(n, measure);
      return sums.values()[0];
    }

    Executor            &executor;
    Constants<dim, Real> constants;
    std::vector<int>     body_sizes; ///< in particles
  };
} // namespace undine::particles

#endif
