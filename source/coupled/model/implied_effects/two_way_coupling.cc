// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/coupled/model/implied_effect.h>

namespace undine
{
  /// Fluid and bodies act on each other.
  template <int dim>
  class TwoWayCoupling : public ImpliedEffect<dim>
  {
  public:
    typename ImpliedEffect<dim>::Call
    call(const Models<dim> &models) const override
    {
      if (models.particles && models.particles->body_names().empty())
        return {false, "no section 'Bodies'"};
      if (models.particles)
        return {models.particles->has_fluid(), "section 'Bodies': one pressure for all particles"};
      if (!models.solid || !models.fluid)
        return {false, models.fluid ? "no section 'Bodies'" : "no section 'Fluid'"};
      if (models.direction == Direction::fluid_to_body)
        return {false, "Coupling / Direction = fluid to body"};
      if (models.direction == Direction::body_to_fluid)
        return {false, "Coupling / Direction = body to fluid"};
      return {true, "sections 'Fluid' and 'Bodies'"};
    }

    std::vector<std::string>
    phases() const override
    {
      return {"couple"};
    }
  };


  namespace
  {
    const RegisterForDimensions<ImpliedEffect, TwoWayCoupling>
      registered_two_way_coupling("two-way coupling", "Fluid and bodies push each other, (C1).");
  }
} // namespace undine
