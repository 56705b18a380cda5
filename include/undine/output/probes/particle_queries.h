// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_output_probes_particle_queries_h
#define undine_output_probes_particle_queries_h

#include <undine/particle_model/particle_model.h>
#include <undine/particle_model/point_grid.h>
#include <undine/particles/model/particle_state.h>

#include <deal.II/base/point.h>

#include <vector>

namespace undine
{
  /// Position in the arrays of a state of the particle with this identity.
  template <int dim>
  std::size_t
  place_of_identity(const particles::ParticleState<dim> &state, const int identity);

  /// Mean pressure, with that at rest, of the particles with these identities, which ascend and
  /// of which there is one at least [Pa].
  template <int dim>
  double
  mean_pressure(const ParticleModel<dim>            &model,
                const particles::ParticleState<dim> &state,
                const std::vector<int>              &identities);

  /// Identity of the particle of body number `body` that rests nearest to `place` [m].
  template <int dim>
  int
  nearest_of_body(const ParticleModel<dim> &model, const int body, const dealii::Point<dim> &place);

  /// Points in a domain, to be asked which of them are near another one, also across periodic
  /// sides.
  template <int dim>
  class PointsAround
  {
  public:
    /// Distances that are asked for are at most `reach` [m].
    PointsAround(const ParticleDomain<dim> &domain, double reach);

    /// Its number is that of the points added before.
    void
    add(const dealii::Point<dim> &point);

    std::size_t
    size() const
    {
      return points.size();
    }

    /// action(number, distance [m]) for all points closer to that with the number `from` than
    /// `distance` [m], that one included.
    template <class Action>
    void
    for_each_near(const std::size_t from, const double distance, const Action &action) const
    {
      grid.for_each_near(points[from], distance, [&](const std::size_t image) {
        action(originals[image], points[from].distance(grid[image]));
      });
    }

  private:
    const ParticleDomain<dim>      &domain;
    double                          reach;     ///< [m]
    std::vector<dealii::Point<dim>> points;    ///< [m]
    PointGrid<dim>                  grid;      ///< of them and their images behind periodic sides
    std::vector<std::size_t>        originals; ///< numbers of the points, of all in the grid
  };

  /// The fluid particles of the largest part that hangs together: no gap wider than `gap` [m], also
  /// across periodic sides. Numbers of particles in the state.
  template <int dim>
  std::vector<std::size_t>
  main_part_of_fluid(const ParticleDomain<dim>           &domain,
                     const particles::ParticleState<dim> &state,
                     const double                         gap);

  /// How far the surface of the fluid is from the centres of its particles, outwards [m]: half a
  /// spacing from those in a plane surface or below it, less from single ones that protrude, by
  /// their number density n over n0. With n1 of the particles in a plane and n2 of all on one side
  /// of it, n0 = n1 + 2 n2: it is n1 + n2 in a plane surface, n2 for one that lies on it, which
  /// ends half a spacing behind its centre, and linear in between.
  template <int dim>
  class SurfaceOffset
  {
  public:
    SurfaceOffset(const ParticleModel<dim> &model, const particles::ParticleState<dim> &state);

    /// Of a particle, by its number in the state.
    double
    operator()(std::size_t number) const;

  private:
    const particles::ParticleState<dim> &state;
    PointsAround<dim>                    points;
    double                               spacing, reach;   ///< [m]
    double                               in_plane, of_all; ///< number densities n1, n0 [1]
  };
} // namespace undine

#endif
