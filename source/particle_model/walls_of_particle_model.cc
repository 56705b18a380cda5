// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/particle_model/particle_model.h>

namespace undine
{
  template <int dim>
  void
  ParticleModel<dim>::add_moving_walls(const std::vector<ParticleBody<dim>> &bodies)
  {
    using particles::Kind;
    for (const auto &obstacle : moving)
      for (const auto &wall : obstacle.at_start())
        {
          occupied.for_each_near(wall.place, overlap * box.spacing, [&](const std::size_t k) {
            throw bodies[constants.body_of[k]].options.error(
              "",
              "the body reaches into an obstacle that moves at (" + write_value(occupied[k]) + ")",
              "Try: move it away by a spacing.");
          });
          add(wall.place,
              dealii::Tensor<1, dim>(),
              particles::Tag::of(wall.layer == 0 ? Kind::wall : Kind::dummy,
                                 particles::moving_material));
          ++constants.n_moving;
        }
  }


  template <int dim>
  void
  ParticleModel<dim>::place_walls(std::vector<WallParticle<dim>>       &walls,
                                  const std::vector<ParticleBody<dim>> &bodies,
                                  const ParticleObstacles<dim>         &obstacles)
  {
    walls.insert(walls.end(), obstacles.particles.begin(), obstacles.particles.end());
    std::vector<WallParticle<dim>> result;
    for (const auto &wall : walls)
      {
        bool room = true; // what is held in a wall takes its place
        occupied.for_each_near(wall.place, apart * box.spacing, [&](const std::size_t k) {
          room = room && !constants.held[k];
        });
        if (!room)
          continue;
        result.push_back(wall);
        occupied.for_each_near(wall.place, overlap * box.spacing, [&](const std::size_t k) {
          const auto &body = bodies[constants.body_of[k]];
          throw body.options.error("",
                                   "the body reaches into a wall at (" + write_value(occupied[k]) +
                                     ")",
                                   "Try: move it away by a spacing, or hold it there.");
        });
      }
    for (const auto &wall : result)
      occupied.add(wall.place);
    for (const auto &obstacle : moving)
      for (const auto &wall : obstacle.at_start())
        occupied.add(wall.place);
    walls = std::move(result);
  }


  template <int dim>
  void
  ParticleModel<dim>::add_walls(const std::vector<WallParticle<dim>> &walls)
  {
    using particles::Kind;
    n_wall = walls.size();
    for (const auto &wall : walls)
      add(wall.place,
          dealii::Tensor<1, dim>(),
          particles::Tag::of(wall.layer == 0 ? Kind::wall : Kind::dummy, 0));
  }


  template <int dim>
  particles::WallPaths<dim>
  ParticleModel<dim>::wall_paths(const double time, const double length) const
  {
    particles::WallPaths<dim> result;
    for (const auto &obstacle : moving)
      obstacle.add_paths(result, time, length);
    return result;
  }


#define UNDINE_INSTANTIATE(dim)                                                               \
  template void ParticleModel<dim>::add_moving_walls(const std::vector<ParticleBody<dim>> &); \
  template void ParticleModel<dim>::place_walls(std::vector<WallParticle<dim>> &,             \
                                                const std::vector<ParticleBody<dim>> &,       \
                                                const ParticleObstacles<dim> &);              \
  template void ParticleModel<dim>::add_walls(const std::vector<WallParticle<dim>> &);        \
  template particles::WallPaths<dim> ParticleModel<dim>::wall_paths(double, double) const;

  UNDINE_INSTANTIATE(2)
  UNDINE_INSTANTIATE(3)
#undef UNDINE_INSTANTIATE
} // namespace undine
