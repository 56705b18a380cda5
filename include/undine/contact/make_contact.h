// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_contact_make_contact_h
#define undine_contact_make_contact_h

#include <undine/fluid/model/fluid_model.h>
#include <undine/solid/assembly/contact.h>
#include <undine/solid/assembly/contact_settings.h>
#include <undine/surface/body_surface.h>
#include <undine/surface/obstacles.h>

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
