// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_interface_make_contact_h
#define undine_interface_make_contact_h

#include <undine/fluid/fluid_model.h>
#include <undine/interface/body_surface.h>
#include <undine/interface/obstacles.h>
#include <undine/solid/contact.h>
#include <undine/solid/contact_settings.h>

#include <memory>

namespace undine
{
  /// The contact of a scene, a BodyContact. `fluid` and `obstacles`: nullptr if there are none. All
  /// references must outlive it. Collective. Throws InputError.
  template <int dim>
  std::shared_ptr<const Contact<dim>>
  make_contact(const ContactSettings<dim> &settings,
               const SolidModel<dim>      &solid,
               const FluidModel<dim>      *fluid,
               const Obstacles<dim>       *obstacles);

  /// The same where only some bodies move, those of `solid`: `bodies` has been made from all of
  /// them, and displacements are those of these bodies. Collective.
  template <int dim>
  std::shared_ptr<const Contact<dim>>
  make_contact(const Contact<dim>     &all,
               const SolidModel<dim>  &solid,
               const BodySurface<dim> &bodies);
} // namespace undine

#endif
