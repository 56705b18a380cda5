// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_fluid_parted_cubes_h
#define undine_fluid_parted_cubes_h

#include <undine/fluid/body_vicinity.h>
#include <undine/fluid/sampled_points.h>

#include <array>
#include <vector>

namespace undine
{
  /// The cubes between points of a lattice that a surface parts like a wall: all eyes on one side
  /// of it see the same samples, which are looked for once instead of by each.
  template <int dim>
  class PartedCubes
  {
  public:
    static constexpr unsigned int n_corners = 1 << dim;

    /// What is seen from one side: the mean, by measure, of each point's samples there.
    struct View
    {
      std::array<double, n_corners>       values;
      std::array<unsigned int, n_corners> n_samples;
    };

    /// Of the cubes between stored points of `field`. Keeps references to nothing.
    PartedCubes(const Field<dim>         &field,
                const SampledPoints<dim> &points,
                const BodyVicinity<dim>  &vicinity);

    /// What `eye` sees of the corners of the cube above point `lower`; nullptr if the cube is not
    /// parted, the eye not in its cells, or so close to the surface that it takes a closer look.
    const View *
    view(const GridIndex<dim> &lower, const dealii::Point<dim> &eye) const;

  private:
    struct Cube
    {
      typename BodyVicinity<dim>::Wall wall;
      std::array<View, 2>              views; ///< from below and from above
    };

    /// Add what can be seen of a corner; false if a sample is too close to the surface to tell from
    /// where.
    static bool
    look(Cube                     &cube,
         const unsigned int        corner,
         const SampledPoints<dim> &points,
         const GridIndex<dim>     &index);

    IndexBox<dim>             box;
    std::vector<unsigned int> cube_above; ///< each point, in `cubes`
    std::vector<Cube>         cubes;      ///< the first is none
  };
} // namespace undine

#endif
