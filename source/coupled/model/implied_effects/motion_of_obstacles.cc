// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/coupled/model/implied_effect.h>

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
        return call(models.particles->setup().n_moving > 0);
      const bool has_obstacles =
        models.surface && models.surface->surface().n_nodes() > models.surface->n_body_nodes();
      if (!has_obstacles)
        return {false, "no section 'Obstacles'"};
      return call(models.surface->obstacles().move());
    }

    std::vector<std::string>
    phases() const override
    {
      return {"cut cells"};
    }

  private:
    static typename ImpliedEffect<dim>::Call
    call(const bool moves)
    {
      const std::string key = "'Obstacles / <name> / Displacement'";
      return {moves, moves ? key : "no " + key};
    }
  };


  namespace
  {
    const RegisterForDimensions<ImpliedEffect, MotionOfObstacles>
      registered_motion_of_obstacles("motion of obstacles",
                                     "Obstacles move as prescribed and push the fluid, (I2).");
  }
} // namespace undine
