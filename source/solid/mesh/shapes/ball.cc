// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/core/registry.h>
#include <undine/solid/mesh/body_shape.h>

#include <deal.II/grid/grid_generator.h>

namespace undine
{
  /// A ball, in 2D a disk: refinement puts new boundary vertices on the sphere.
  template <int dim>
  class Ball : public BodyShape<dim>
  {
  public:
    void
    add_options(const Options &options) override
    {
      options.add("Centre", centre, "m", Allowed::anything(), "Of the ball.");
      options.add("Radius", radius, "m", Allowed::positive(), "Of the ball.");
    }

    void
    make_mesh(dealii::Triangulation<dim> &mesh) const override
    {
      dealii::GridGenerator::hyper_ball_balanced(mesh, centre, radius);
    }

    typename BodyShape<dim>::Sides
    sides(const dealii::Triangulation<dim> &) const override
    {
      return {{"surface", 0}};
    }

  private:
    dealii::Point<dim> centre;
    double             radius = 1;
  };


  static const RegisterForDimensions<BodyShape, Ball> ball("ball", "A ball or disk; side surface.");
} // namespace undine
