// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/coupled/model/implied_effect.h>

namespace undine
{
  /// Bodies whose stiffness depends on their deformation: it is assembled anew for every correction
  /// of Newton's method.
  template <int dim>
  class FiniteStrain : public ImpliedEffect<dim>
  {
  public:
    typename ImpliedEffect<dim>::Call
    call(const Models<dim> &models) const override
    {
      if (models.particles && !models.particles->body_names().empty())
        return {true, "bodies of particles turn and deform at will"};
      if (!models.solid)
        return {false, "no section 'Bodies'"};
      const auto names =
        names_of_bodies(models, [](const auto &body) { return body.material->is_objective(); });
      if (names.empty())
        return {false, "every 'Bodies / <name> / Material' is a law of small strains"};
      return {true, "'Material' of " + names};
    }

    std::vector<std::string>
    phases() const override
    {
      return {"assemble tangent"};
    }
  };


  namespace
  {
    const RegisterForDimensions<ImpliedEffect, FiniteStrain>
      registered_finite_strain("finite strain", "Large strains and rotations of bodies.");
  }
} // namespace undine
