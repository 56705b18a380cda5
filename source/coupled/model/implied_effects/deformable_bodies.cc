// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/coupled/model/implied_effect.h>

namespace undine
{
  /// Bodies that move and deform by the forces on them.
  template <int dim>
  class DeformableBodies : public ImpliedEffect<dim>
  {
  public:
    typename ImpliedEffect<dim>::Call
    call(const Models<dim> &models) const override
    {
      if (models.particles && !models.particles->body_names().empty())
        return {true, "section 'Bodies'"};
      if (!models.solid)
        return {false, "no section 'Bodies'"};
      return {true, "Bodies / " + names_of_bodies(models, [](const auto &) { return true; })};
    }

    std::vector<std::string>
    phases() const override
    {
      return {"assemble forces", "assemble tangent", "solve linear system", "elastic steps"};
    }
  };


  namespace
  {
    const RegisterForDimensions<ImpliedEffect, DeformableBodies>
      registered_deformable_bodies("deformable bodies",
                                   "Bodies move and deform by the forces on them, (T1).");
  }
} // namespace undine
