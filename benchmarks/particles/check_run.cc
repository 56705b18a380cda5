// SPDX-License-Identifier: LGPL-2.1-or-later
#include "check_run.h"

#include <cmath>
#include <cstdio>
#include <utility>
#include <vector>

namespace undine::particles
{
  namespace
  {
    /// Front over a at T = t sqrt(2 g / a), Koshizuka and Oka 1996, experiment; 0 outside of it.
    double
    measured_front(const double T)
    {
      const std::vector<std::pair<double, double>> points{{0.381, 1.111},
                                                          {0.769, 1.252},
                                                          {1.153, 1.505},
                                                          {1.537, 1.892},
                                                          {1.935, 2.241},
                                                          {2.323, 2.615},
                                                          {2.719, 3.003},
                                                          {3.096, 3.624}};
      for (std::size_t k = 1; k < points.size(); ++k)
        if (points[k - 1].first <= T && T <= points[k].first)
          return points[k - 1].second + (points[k].second - points[k - 1].second) *
                                          (T - points[k - 1].first) /
                                          (points[k].first - points[k - 1].first);
      return 0;
    }


    /// Says what is wrong, if it is.
    bool
    holds(const bool condition, const char *complaint)
    {
      if (!condition)
        std::printf("  WRONG: %s\n", complaint);
      return condition;
    }


    bool
    are_bodies_plausible(const Balance<3> &balance)
    {
      bool good = holds(balance.fluid_in_bodies == 0, "there is water in the sphere");
      for (std::size_t b = 0; b < balance.body_volumes.size(); ++b)
        {
          const auto &x = balance.body_centres[b], &v = balance.body_velocities[b];
          std::printf("  body %zu: volume %.4f of that at rest, centre at (%.3f, %.3f, %.3f), "
                      "velocity (%.3f, %.3f, %.3f)\n",
                      b,
                      balance.body_volumes[b],
                      x[0],
                      x[1],
                      x[2],
                      v[0],
                      v[1],
                      v[2]);
          good &= holds(std::abs(balance.body_volumes[b] - 1) < 0.05, "the sphere's volume");
        }
      return good;
    }
  } // namespace


  double
  energy_of(const Balance<3> &balance)
  {
    return balance.kinetic_fluid + balance.kinetic_solid + balance.potential + balance.elastic;
  }


  bool
  is_plausible(const DamBreak &dam, const Engine<3> &engine, const TimedRun &run)
  {
    ParticleState<3> state;
    engine.fetch(state);
    const auto   balance = engine.balance();
    const double T       = run.time * std::sqrt(2 * 9.81 / DamBreak::width);
    const double front = dam.front(state), lost = run.energy_before - energy_of(balance);
    const int    outside = dam.count_outside(state);
    std::printf("  at T = %.2f: front %.2f a, energy lost since the beginning of the timing %.3f J "
                "of %.1f J kinetic, %d particles outside\n",
                T,
                front,
                lost,
                balance.kinetic_fluid,
                outside);
    bool good = holds(outside == 0, "particles have left the tank");
    good &= holds(lost > -1e-3 * balance.kinetic_fluid, "the energy has grown");
    good &= holds(run.not_converged == 0, "pressure equations were not solved");
    const double measured = measured_front(T);
    if (balance.body_volumes.empty() && measured > 0)
      {
        std::printf("  front of Koshizuka and Oka's experiment: %.2f a\n", measured);
        good &= holds(front > 0.95 * measured && front < 1.2 * measured, "the front's place");
      }
    return are_bodies_plausible(balance) && good;
  }
} // namespace undine::particles
