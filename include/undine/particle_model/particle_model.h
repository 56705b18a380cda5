// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_particle_model_particle_model_h
#define undine_particle_model_particle_model_h

#include <undine/effects/effect.h>
#include <undine/particle_model/particle_body.h>
#include <undine/particle_model/particle_domain.h>
#include <undine/particle_model/particle_fluid.h>
#include <undine/particle_model/particle_numerics.h>
#include <undine/particle_model/particle_walls.h>
#include <undine/particle_model/point_grid.h>
#include <undine/particles/model/particle_state.h>
#include <undine/particles/setup/setup.h>

#include <deal.II/base/mpi.h>

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace undine
{
  /// A scene of particles: what does not change during a run, and how it begins. The bridge from
  /// the parameter file to `particles`, which knows neither of it nor of deal.II.
  template <int dim>
  class ParticleModel
  {
  public:
    /// Read the sections `Particles`, `Domain`, `Fluid`, `Bodies`, `Obstacles` and `Output`, and
    /// place all particles. Throws InputError, also if there is more than one rank.
    ParticleModel(const Options &scene, const Effects<dim> &effects, MPI_Comm communicator);

    /// Declare the keys without building anything.
    static void
    declare(const Options &scene);

    const particles::Setup<dim> &
    setup() const
    {
      return constants;
    }

    const particles::ParticleState<dim> &
    initial_state() const
    {
      return start;
    }

    /// How obstacles move in a frame of `length` [s] that begins at `time` [s].
    particles::WallPaths<dim>
    wall_paths(double time, double length) const;

    const ParticleNumerics &
    numerics() const
    {
      return particle_numerics;
    }

    const ParticleDomain<dim> &
    domain() const
    {
      return box;
    }

    /// The direction of length 1 out of walls and obstacles at the start, of that of their surfaces
    /// that is nearest to `place`; zero if none is within `reach` [m].
    dealii::Tensor<1, dim>
    out_of_wall(const dealii::Point<dim> &place, double reach) const;

    const std::vector<std::string> &
    body_names() const
    {
      return names;
    }

    bool
    has_fluid() const
    {
      return constants.has_fluid;
    }

    /// Does the scene have inflows or outflows?
    bool
    has_openings() const
    {
      return n_openings > 0;
    }

    /// Is there hardly room for more than `n` particles of fluid, although it flows in and nowhere
    /// out?
    bool
    is_nearly_full(const std::size_t n) const
    {
      return most_fluid > 0 && n > 0.9 * most_fluid;
    }

    /// Whether pictures contain the particles of walls.
    bool
    shows_walls() const
    {
      return walls_are_shown;
    }

    MPI_Comm
    communicator() const
    {
      return ranks;
    }

    /// How many particles of which kind there are, in words.
    std::string
    counts() const;

    /// Of all kinds together.
    std::size_t
    n_particles() const;

    /// What the user may not expect; one sentence each.
    const std::vector<std::string> &
    notes() const
    {
      return remarks;
    }

  private:
    static constexpr double apart   = 0.9;  ///< other kinds of particles at the start [spacings]
    static constexpr double overlap = 0.55; ///< nearer ones lie on each other [spacings]

    void
    apply(const Effects<dim> &effects, const Options &scene);
    void
    place_bodies(std::vector<ParticleBody<dim>> &bodies, const ParticleObstacles<dim> &obstacles);
    void
    add_body(const ParticleBody<dim> &body);
    /// Before all walls that do not move, and fluid.
    void
    add_moving_walls(const std::vector<ParticleBody<dim>> &bodies);
    void
    place_walls(std::vector<WallParticle<dim>>       &walls,
                const std::vector<ParticleBody<dim>> &bodies,
                const ParticleObstacles<dim>         &obstacles);
    void
    check_room(const ParticleFluid<dim>                              &fluid,
               const std::function<bool(const dealii::Point<dim> &)> &taken);
    /// Whether the fluid has a surface. Throws InputError if one of several parts has none.
    void
    find_surface(const ParticleFluid<dim> &fluid, const ParticleObstacles<dim> &obstacles);
    /// Of the body force, per mass; 0 for no places [J/kg].
    double
    largest_potential(const std::vector<dealii::Point<dim>> &places) const;
    void
    check_layers(const ParticleFluid<dim>              &fluid,
                 const std::vector<LayerParticle<dim>> &layers,
                 const ParticleObstacles<dim>          &obstacles) const;
    void
    add_fluid(ParticleFluid<dim>             &fluid,
              std::vector<LayerParticle<dim>> layers,
              const ParticleObstacles<dim>   &obstacles);
    /// And bound depth and sub-steps by what flows in. `gravity` [m/s^2].
    void
    add_layers(const std::vector<LayerParticle<dim>> &layers,
               const dealii::Tensor<1, dim>          &gravity);
    void
    add_walls(const std::vector<WallParticle<dim>> &walls);
    void
    add(const dealii::Point<dim>     &place,
        const dealii::Tensor<1, dim> &velocity,
        const particles::Tag          tag);

    MPI_Comm                                                 ranks;
    ParticleNumerics                                         particle_numerics;
    ParticleDomain<dim>                                      box;
    particles::Setup<dim>                                    constants;
    particles::ParticleState<dim>                            start;
    std::vector<std::string>                                 names; ///< of the bodies
    std::vector<MovingObstacle<dim>>                         moving;
    std::vector<std::unique_ptr<const SurfaceDistance<dim>>> surfaces; ///< of obstacles, at start
    std::size_t              n_fluid = 0, n_layers = 0, n_wall = 0, n_openings = 0;
    std::size_t              most_fluid      = 0; ///< that closed walls have room for; 0: any
    bool                     walls_are_shown = false;
    std::vector<std::string> remarks;
    PointGrid<dim>           occupied; ///< by bodies, then also by walls
  };
} // namespace undine

#endif
