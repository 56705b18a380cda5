// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_coupled_models_h
#define undine_coupled_models_h

#include <undine/coupled/direction.h>
#include <undine/coupled/particle_model.h>
#include <undine/effects/effect.h>
#include <undine/fluid/fluid_model.h>
#include <undine/interface/immersed_surface.h>
#include <undine/interface/make_contact.h>
#include <undine/interface/void_regions.h>
#include <undine/solid/solid_model.h>

#include <algorithm>
#include <memory>

namespace undine
{
  /// What a scene is made of; constant during a run.
  template <int dim>
  struct Models
  {
    std::unique_ptr<const SolidModel<dim>> solid; ///< nullptr: no bodies
    std::unique_ptr<const FluidModel<dim>> fluid; ///< nullptr: no fluid
    Effects<dim>                           effects;
    Direction                              direction = Direction::two_way;

    /// Of fluid and bodies, in place of the two models above; nullptr: there are none.
    std::unique_ptr<const ParticleModel<dim>> particles;

    /// Of everything that stands in the fluid; nullptr: nothing does.
    std::unique_ptr<const ImmersedSurface<dim>> surface;
    std::unique_ptr<const VoidRegions<dim>>     void_regions; ///< nullptr: there are none

    /// All ranks that compute the scene.
    MPI_Comm
    communicator() const
    {
      if (particles)
        return particles->communicator();
      return solid ? solid->communicator() : fluid->grid().communicator();
    }

    /// Does the fluid stick to surfaces?
    bool
    has_friction() const
    {
      return std::any_of(effects.begin(), effects.end(), [](const auto &effect) {
        return effect->sticks_to_surfaces();
      });
    }

    /// What the effects do to the bodies. Collective.
    SolidEnvironment<dim>
    environment() const
    {
      SolidEnvironment<dim> result;
      for (const auto &effect : effects)
        effect->affect(result);
      if (solid && result.contact_settings)
        result.contact = make_contact<dim>(
          *result.contact_settings, *solid, fluid.get(), surface ? &surface->obstacles() : nullptr);
      return result;
    }

    bool
    have_contact() const
    {
      SolidEnvironment<dim> result;
      for (const auto &effect : effects)
        effect->affect(result);
      return result.contact_settings.has_value();
    }
  };
} // namespace undine

#endif
