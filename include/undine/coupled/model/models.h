// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_coupled_model_models_h
#define undine_coupled_model_models_h

#include <undine/contact/make_contact.h>
#include <undine/coupled/model/direction.h>
#include <undine/effects/effect.h>
#include <undine/fluid/model/fluid_model.h>
#include <undine/operators/void_regions.h>
#include <undine/particle_model/particle_model.h>
#include <undine/solid/mesh/solid_model.h>
#include <undine/surface/immersed_surface.h>

#include <algorithm>
#include <memory>
#include <optional>

namespace undine
{
  /// The models that a scene consists of; constant during a run.
  template <int dim>
  struct Models
  {
    std::shared_ptr<const SolidModel<dim>> solid; ///< nullptr: no bodies
    std::shared_ptr<const FluidModel<dim>> fluid; ///< nullptr: no fluid
    Effects<dim>                           effects;
    Direction                              direction = Direction::two_way;

    /// Particles of fluid and bodies, in place of the two models above; nullptr: there are none.
    std::unique_ptr<const ParticleModel<dim>> particles;

    /// The surfaces of all bodies and obstacles in the fluid; nullptr: there are none.
    std::shared_ptr<const ImmersedSurface<dim>> surface;
    std::shared_ptr<const VoidRegions<dim>>     void_regions; ///< nullptr: there are none

    /// Where only some bodies are awake (SleepingBodies): what environment() returns.
    std::optional<SolidEnvironment<dim>> for_awake;

    /// All ranks that compute the scene.
    MPI_Comm
    communicator() const
    {
      if (particles)
        return particles->communicator();
      return solid ? solid->communicator() : fluid->grid().communicator();
    }

    /// Are surfaces no-slip surfaces? They are if an effect asks for friction.
    bool
    has_friction() const
    {
      return std::any_of(effects.begin(), effects.end(), [](const auto &effect) {
        return effect->needs_no_slip_surfaces();
      });
    }

    /// Do bodies sleep, whose surfaces stand still?
    bool
    has_sleepers() const
    {
      return for_awake && for_awake->asleep;
    }

    /// The effects on the bodies, with the contact of all of them. Collective.
    SolidEnvironment<dim>
    environment() const
    {
      if (for_awake)
        return *for_awake;
      auto result    = requests_of_effects();
      result.contact = contact_of_bodies();
      return result;
    }

    /// The same without Contact, which has to be built.
    SolidEnvironment<dim>
    requests_of_effects() const
    {
      SolidEnvironment<dim> result;
      for (const auto &effect : effects)
        effect->affect(result);
      return result;
    }

    /// The contact of all bodies; nullptr if the scene has none. Collective.
    std::shared_ptr<const Contact<dim>>
    contact_of_bodies() const
    {
      const auto settings = requests_of_effects().contact_settings;
      if (!solid || !settings)
        return nullptr;
      return make_contact<dim>(
        *settings, *solid, fluid.get(), surface ? &surface->obstacles() : nullptr);
    }
  };
} // namespace undine

#endif
