// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/particle_model/particle_walls.h>
#include <undine/particle_model/point_grid.h>
#include <undine/surface/obstacle_description.h>
#include <undine/surface/shape_boundary.h>

#include <algorithm>
#include <cmath>

namespace undine
{
  namespace
  {
    constexpr double       rounding_in_walls = 1e-6; // [spacings]
    constexpr double       nearest_accepted  = 0.6;  // [spacings]
    constexpr double       misfit            = 0.2;  // of the depth [spacings]
    constexpr double       room              = 0.85; // that a misfit needs [spacings]
    constexpr unsigned int projections       = 5;    // after which depths are right, if they can be
    constexpr unsigned int relaxations       = 60;


    template <int dim>
    PointGrid<dim>
    grid_of(const std::vector<WallParticle<dim>> &particles, const double reach)
    {
      PointGrid<dim> grid(reach);
      for (const auto &particle : particles)
        grid.add(particle.place);
      return grid;
    }


    /// To the depth of its layer; in corners that takes several calls.
    template <int dim>
    void
    project(WallParticle<dim> &particle, const SurfaceDistance<dim> &surface, const double spacing)
    {
      const auto   nearest = surface.nearest(particle.place);
      const double depth   = (particle.layer + 0.5) * spacing;
      // The direction in which the depth falls; on the surface itself only its normal tells.
      const auto outwards =
        std::abs(nearest.distance) > 1e-3 * spacing
          ? dealii::Tensor<1, dim>((particle.place - nearest.place) / nearest.distance)
          : nearest.outwards;
      particle.place = nearest.place - depth * outwards;
    }


    /// Where it rests, or is at the start of a motion.
    template <int dim>
    std::unique_ptr<const SurfaceDistance<dim>>
    closed_surface(const ShapeDescription<dim> &description,
                   const Expression<dim, dim>  *displacement = nullptr)
    {
      auto       boundary = make_shape_boundary(description);
      const auto surface  = boundary.surface(description.name);
      if (displacement != nullptr)
        for (auto &node : boundary.nodes)
          node += displacement->vector(node, 0.);
      check_closed(surface, boundary.nodes);
      return std::make_unique<const SurfaceDistance<dim>>(surface, boundary.nodes);
    }


    /// Lattice points inside the surface as far as walls reach, with their layers.
    template <int dim>
    std::vector<WallParticle<dim>>
    lattice_points(const ParticleDomain<dim>      &domain,
                   const dealii::BoundingBox<dim> &region,
                   const SurfaceDistance<dim>     &surface)
    {
      const double         l0 = domain.spacing;
      std::array<int, dim> begin, index, end;
      for (unsigned int axis = 0; axis < dim; ++axis)
        {
          const double width = domain.layers * l0; // in the walls around, for an even end
          const double from =
            std::max(surface.box().lower_bound(axis) - l0, region.lower_bound(axis) - width);
          const double to =
            std::min(surface.box().upper_bound(axis) + l0, region.upper_bound(axis) + width);
          begin[axis] = std::floor((from - domain.lower[axis]) / l0);
          end[axis]   = std::ceil((to - domain.lower[axis]) / l0);
          if (begin[axis] >= end[axis])
            return {};
        }
      std::vector<WallParticle<dim>> result;
      index = begin;
      for (unsigned int axis = 0; axis < dim;)
        {
          dealii::Point<dim> place;
          for (unsigned int d = 0; d < dim; ++d)
            place[d] = domain.lower[d] + (index[d] + 0.5) * l0;
          const double depth = -surface.nearest(place).distance / l0;
          const int    layer = static_cast<int>(std::floor(depth + rounding_in_walls));
          if (layer >= 0 && layer < static_cast<int>(domain.layers))
            result.push_back({place, static_cast<unsigned int>(layer)});
          for (axis = 0; axis < dim && ++index[axis] == end[axis]; ++axis)
            index[axis] = begin[axis];
        }
      return result;
    }


    /// Leave out those of deeper layers for which a thin wall has no room.
    template <int dim>
    std::vector<WallParticle<dim>>
    without_misfits(const std::vector<WallParticle<dim>> &particles,
                    const ParticleDomain<dim>            &domain,
                    const SurfaceDistance<dim>           &surface)
    {
      const double                   l0 = domain.spacing;
      PointGrid<dim>                 fitting(l0);
      std::vector<WallParticle<dim>> result, misfits;
      for (const auto &particle : particles)
        {
          const double depth = -surface.nearest(particle.place).distance / l0;
          if (std::abs(depth - particle.layer - 0.5) < misfit)
            {
              fitting.add(particle.place);
              result.push_back(particle);
            }
          else
            misfits.push_back(particle);
        }
      for (const auto &particle : misfits)
        if (!fitting.any_near(particle.place, room * l0))
          {
            fitting.add(particle.place);
            result.push_back(particle);
          }
      return result;
    }


    /// Move those that are closer than a spacing a little apart.
    template <int dim>
    void
    push_apart(std::vector<WallParticle<dim>> &particles, const double spacing)
    {
      const auto grid = grid_of(particles, spacing);
      for (std::size_t i = 0; i < particles.size(); ++i)
        {
          dealii::Tensor<1, dim> push;
          grid.for_each_near(grid[i], (1 - rounding_in_walls) * spacing, [&](const std::size_t j) {
            const auto   way    = grid[i] - grid[j];
            const double length = way.norm();
            if (length > 0)
              push += (spacing - length) / length * way;
          });
          const double length = push.norm();
          if (length > 0)
            particles[i].place += std::min(0.3, 0.1 * spacing / length) * push;
        }
    }


    /// Those that are in the region and not on each other, upper layers first.
    template <int dim>
    std::vector<WallParticle<dim>>
    accepted(std::vector<WallParticle<dim>>  particles,
             const ParticleDomain<dim>      &domain,
             const dealii::BoundingBox<dim> &region,
             const SurfaceDistance<dim>     &surface)
    {
      std::stable_sort(particles.begin(), particles.end(), [](const auto &a, const auto &b) {
        return a.layer < b.layer;
      });
      PointGrid<dim>                 kept(domain.spacing);
      std::vector<WallParticle<dim>> result;
      for (const auto &particle : particles)
        if (region.point_inside(particle.place, 0.) &&
            surface.nearest(particle.place).distance < 0 &&
            !kept.any_near(particle.place, nearest_accepted * domain.spacing))
          {
            kept.add(particle.place);
            result.push_back(particle);
          }
      return result;
    }
  } // namespace


  template <int dim>
  std::vector<WallParticle<dim>>
  fit_wall_particles(const ParticleDomain<dim>      &domain,
                     const dealii::BoundingBox<dim> &region,
                     const SurfaceDistance<dim>     &surface)
  {
    auto particles = lattice_points(domain, region, surface);
    for (unsigned int k = 0; k < relaxations; ++k)
      {
        if (k > 0)
          push_apart(particles, domain.spacing);
        for (auto &particle : particles)
          project(particle, surface, domain.spacing);
        if (k == projections)
          particles = without_misfits(particles, domain, surface);
      }
    return accepted(particles, domain, region, surface);
  }


  template <int dim>
  bool
  ParticleObstacles<dim>::contain(const dealii::Point<dim> &place) const
  {
    return std::any_of(surfaces.begin(), surfaces.end(), [&](const auto &surface) {
      const auto box = surface->box();
      return box.point_inside(place) && surface->nearest(place).distance < 0;
    });
  }


  namespace
  {
    template <int dim>
    std::vector<WallParticle<dim>>
    fitted(const Obstacle<dim>            &obstacle,
           const ParticleDomain<dim>      &domain,
           const dealii::BoundingBox<dim> &region,
           const SurfaceDistance<dim>     &surface)
    {
      const auto result = fit_wall_particles(domain, region, surface);
      if (result.empty())
        throw obstacle.description.options.error(
          "",
          "the obstacle holds no particle: it is outside the domain or thinner than a spacing",
          "Try: a smaller 'Particles / Spacing', or a larger obstacle.");
      return result;
    }


    template <int dim>
    void
    add_fixed(ParticleObstacles<dim>    &result,
              PointGrid<dim>            &taken,
              const Obstacle<dim>       &obstacle,
              const ParticleDomain<dim> &domain)
    {
      auto surface = closed_surface(obstacle.description);
      for (const auto &particle :
           fitted(obstacle, domain, {{domain.lower, domain.upper}}, *surface))
        {
          if (result.contain(particle.place) ||
              taken.any_near(particle.place, nearest_accepted * domain.spacing))
            continue; // in an obstacle that came before
          taken.add(particle.place);
          result.particles.push_back(particle);
        }
      result.surfaces.push_back(std::move(surface));
    }


    /// All of it, for it may come into the domain.
    template <int dim>
    void
    add_moving(ParticleObstacles<dim>    &result,
               PointGrid<dim>            &taken,
               const Obstacle<dim>       &obstacle,
               const ParticleDomain<dim> &domain)
    {
      const auto &description = obstacle.description;
      const auto  at_rest     = closed_surface(description);
      auto        region      = at_rest->box();
      region.extend(domain.spacing);
      result.moving.emplace_back(description.options,
                                 description.name,
                                 obstacle.displacement,
                                 fitted(obstacle, domain, region, *at_rest));
      const auto particles = result.moving.back().at_start();
      for (const auto &particle : particles)
        if (taken.any_near(particle.place, nearest_accepted * domain.spacing))
          throw description.options.error(
            "",
            "the obstacle moves and is on another one that moves at (" +
              write_value(particle.place) + ")",
            "Try: move them apart.");
      for (const auto &particle : particles)
        taken.add(particle.place);
      result.surfaces.push_back(closed_surface(description, &obstacle.displacement));
    }
  } // namespace


  template <int dim>
  ParticleObstacles<dim>
  read_particle_obstacles(const Options &scene, const ParticleDomain<dim> &domain)
  {
    ParticleObstacles<dim> result;
    PointGrid<dim>         taken(domain.spacing), taken_by_moving(domain.spacing);
    for (const auto &obstacle : read_obstacles<dim>(scene))
      if (obstacle.displacement.is_zero())
        add_fixed(result, taken, obstacle, domain);
      else
        add_moving(result, taken_by_moving, obstacle, domain);
    return result;
  }


  template <int dim>
  void
  declare_particle_obstacles(const Options &scene)
  {
    read_obstacles<dim>(scene);
  }


#define UNDINE_INSTANTIATE(dim)                                                                   \
  template std::vector<WallParticle<dim>> fit_wall_particles(                                     \
    const ParticleDomain<dim> &, const dealii::BoundingBox<dim> &, const SurfaceDistance<dim> &); \
  template struct ParticleObstacles<dim>;                                                         \
  template ParticleObstacles<dim> read_particle_obstacles(const Options &,                        \
                                                          const ParticleDomain<dim> &);           \
  template void                   declare_particle_obstacles<dim>(const Options &);

  UNDINE_INSTANTIATE(2)
  UNDINE_INSTANTIATE(3)
#undef UNDINE_INSTANTIATE
} // namespace undine
