// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/coupled/implied_effect.h>

namespace undine
{
  /// Obstacles that move as prescribed. Fixed ones cost nothing from step to step.
  template <int dim>
  class MotionOfObstacles : public ImpliedEffect<dim>
  {
  public:
    typename ImpliedEffect<dim>::Call
    call(const Models<dim> &models) const override
    {
      if (models.particles)
        return {models.particles->setup().n_moving > 0, "Obstacles / <name> / Displacement"};
      const bool has_obstacles =
        models.surface && models.surface->surface().n_nodes() > models.surface->n_body_nodes();
      if (!has_obstacles)
        return {false, "no section 'Obstacles'"};
      if (!models.surface->obstacles().move())
        return {false, "no 'Obstacles / <name> / Displacement'"};
      return {true, "Obstacles / <name> / Displacement"};
    }

    std::vector<std::string>
    phases() const override
    {
      return {"cut cells"};
    }
  };


  namespace
  {
    const RegisterForDimensions<ImpliedEffect, MotionOfObstacles>
      registered("motion of obstacles", "Obstacles move as prescribed and push the fluid, (I2).");
  }
} // namespace undine
