// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/solid/material/material.h>

namespace undine
{
  bool
  Material::has_separate_volumetric_part() const
  {
    return false;
  }


  double
  Material::volumetric_energy(const double) const
  {
    return 0;
  }


  double
  Material::volumetric_stress(const double) const
  {
    return 0;
  }


  double
  Material::volumetric_tangent(const double) const
  {
    return 0;
  }


  bool
  Material::tolerates_inversion() const
  {
    return false;
  }


  bool
  Material::is_objective() const
  {
    return true;
  }
} // namespace undine
