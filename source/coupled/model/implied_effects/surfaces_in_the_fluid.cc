// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/coupled/model/implied_effect.h>

namespace undine
{
  /// Bodies and obstacles that cut the grid of the fluid: once, or wherever they move.
  template <int dim>
  class SurfacesInTheFluid : public ImpliedEffect<dim>
  {
  public:
    typename ImpliedEffect<dim>::Call
    call(const Models<dim> &models) const override
    {
      if (models.particles)
        return {false, "particles have no grid"};
      if (!models.surface)
        return {false, models.fluid ? "no section 'Bodies' or 'Obstacles'" : "no section 'Fluid'"};
      std::string names;
      for (const auto &name : models.surface->section_names())
        names += (names.empty() ? "" : ", ") + name;
      return {true, names};
    }

    std::vector<std::string>
    phases() const override
    {
      return {"cut cells"};
    }
  };


  namespace
  {
    const RegisterForDimensions<ImpliedEffect, SurfacesInTheFluid>
      registered_surfaces_in_the_fluid("surfaces in the fluid",
                                       "Bodies and obstacles cut the grid, (I1)-(I4).");
  }
} // namespace undine
