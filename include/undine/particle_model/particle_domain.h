// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_particle_model_particle_domain_h
#define undine_particle_model_particle_domain_h

#include <undine/base/options/options.h>

#include <deal.II/base/point.h>

#include <array>
#include <vector>

namespace undine
{
  template <int dim>
  struct ParticleBody;

  /// What a side of the box of particles is.
  enum class ParticleSide
  {
    wall,
    open,
    periodic
  };

  /// A particle of a wall at rest.
  template <int dim>
  struct WallParticle
  {
    dealii::Point<dim> place; ///< [m]
    unsigned int       layer; ///< 0: next to the fluid
  };

  /// The box in which fluid and bodies of particles are, and its lattice: particles lie in the
  /// centres of cubes of edge `spacing`, of which a whole number fits in every direction.
  template <int dim>
  class ParticleDomain
  {
  public:
    /// Read the section `Domain`; without it and a fluid there is room around the bodies. Throws
    /// InputError. `reach` is that of the weight [spacings].
    ParticleDomain(const Options &scene, const double spacing, const double reach);

    /// Edge of the cubes [m]
    double spacing;
    /// Layers of particles that a wall needs: as deep as a fluid particle's or wall particle's
    /// neighbours may be.
    unsigned int layers;

    dealii::Point<dim>                lower, upper; ///< of the inside [m]
    std::array<unsigned int, dim>     cells;
    std::array<ParticleSide, 2 * dim> sides;    ///< left, right, bottom, ...
    double                            room = 0; ///< beyond open sides [m]

    bool
    periodic(const unsigned int axis) const
    {
      return sides[2 * axis] == ParticleSide::periodic;
    }

    /// The shortest way to `to` from `from`, across periodic sides where that is shorter [m].
    dealii::Tensor<1, dim>
    way(const dealii::Point<dim> &to, const dealii::Point<dim> &from) const;

    bool
    contains(const dealii::Point<dim> &place) const;

    /// How far a place is outside, along the axis along which it is farthest [m]; negative inside.
    /// Beyond open sides as far as there is room counts as inside.
    double
    distance_outside(const dealii::Point<dim> &place) const;

    /// Corners of all that particles may reach, walls and a margin included [m]. @{
    dealii::Point<dim>
    outermost_lower() const;
    dealii::Point<dim>
    outermost_upper() const;
    /// @}

    /// Call action(centre) for all cubes, the first direction running fastest.
    template <class Action>
    void
    for_each_cell(const Action &action) const
    {
      std::array<int, dim> begin{}, end;
      for (unsigned int axis = 0; axis < dim; ++axis)
        end[axis] = cells[axis];
      for_each_centre(
        begin, end, [&](const dealii::Point<dim> &centre, const auto &) { action(centre); });
    }

    /// The walls around the box: lattice layers, exact at the sides.
    std::vector<WallParticle<dim>>
    wall_particles() const;

  private:
    /// Room around bodies in a scene that has nothing else.
    void
    surround(const std::vector<ParticleBody<dim>> &bodies);
    void
    read_corners(const Options &domain);
    void
    read_sides(const Options &domain);

    template <class Action>
    void
    for_each_centre(const std::array<int, dim> &begin,
                    const std::array<int, dim> &end,
                    const Action               &action) const
    {
      auto index = begin;
      for (unsigned int axis = 0; axis < dim;)
        {
          dealii::Point<dim> centre;
          for (unsigned int d = 0; d < dim; ++d)
            centre[d] = lower[d] + (index[d] + 0.5) * spacing;
          action(centre, index);
          for (axis = 0; axis < dim && ++index[axis] == end[axis]; ++axis)
            index[axis] = begin[axis];
        }
    }
  };
} // namespace undine

#endif
