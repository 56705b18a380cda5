// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_solid_material_isotropic_material_h
#define undine_solid_material_isotropic_material_h

#include <undine/solid/material/elastic_constants.h>
#include <undine/solid/material/material.h>

namespace undine
{
  /// A law that users describe by Young's modulus and Poisson's ratio at rest.
  class IsotropicMaterial : public Material
  {
  public:
    void
    add_options(const Options &options) override
    {
      constants.add_options(options);
      lambda = constants.lame_modulus();
      mu     = constants.shear_modulus();
      bulk   = constants.bulk_modulus();
    }

    double
    p_wave_modulus() const override
    {
      return constants.p_wave_modulus();
    }

  protected:
    double lambda = 0; ///< Lame's first constant [Pa]
    double mu     = 0; ///< shear modulus [Pa]
    double bulk   = 0; ///< bulk modulus K [Pa]

  private:
    ElasticConstants constants;
  };
} // namespace undine

#endif
