// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_contact_domain_walls_h
#define undine_contact_domain_walls_h

#include <undine/fluid/model/fluid_model.h>
#include <undine/solid/assembly/contact_settings.h>

#include <vector>

namespace undine
{
  /// A side of the fluid's domain, with the plane that it lies in.
  template <int dim>
  struct DomainWall
  {
    Side             side;
    ContactWall<dim> plane;     ///< its normal points into the domain
    bool             is_closed; ///< fluid passes nowhere; else through a part of it
  };

  /// All sides of the domain that are walls, at least in part: fluid neither enters nor leaves
  /// there.
  template <int dim>
  std::vector<DomainWall<dim>>
  domain_walls(const FluidModel<dim> &fluid);
} // namespace undine

#endif
