// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_benchmarks_particles_dam_break_h
#define undine_benchmarks_particles_dam_break_h

#include <undine/particles/model/particle_state.h>
#include <undine/particles/setup/setup.h>

namespace undine::particles
{
  /// A column of water, a x a x 2 a, at one end of a tank that is 4 a long and 3 a high, periodic
  /// along y, with walls of three layers; and an elastic sphere of radius a/4 on the floor.
  class DamBreak
  {
  public:
    enum class Sphere
    {
      without,
      with
    };

    static constexpr double width = 0.5; ///< a [m]

    /// `n` particles along a.
    DamBreak(int n, Sphere sphere);

    Setup<3>         setup;
    ParticleState<3> start;

    /// Largest x/a of the water's main part: one particle in a thousand may be ahead.
    double
    front(const ParticleState<3> &state) const;

    /// How many free particles have left the tank.
    int
    count_outside(const ParticleState<3> &state) const;

  private:
    void
    add(const Vector<3, double> &x, Tag tag);

    void
    add_sphere();

    int
    depth_in_walls(int i, int k) const;

    bool
    is_in_sphere(const Vector<3, double> &x) const;

    int               n;
    double            l0;
    bool              has_sphere;
    Vector<3, double> centre; ///< of the sphere
  };
} // namespace undine::particles

#endif
