// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_solid_material_elastic_constants_h
#define undine_solid_material_elastic_constants_h

#include <undine/base/options/options.h>

namespace undine
{
  /// The two constants of an isotropic solid at rest, as users know them, and what follows.
  struct ElasticConstants
  {
    double youngs_modulus = 1e6; ///< E [Pa]
    double poissons_ratio = 0.3; ///< nu [1]

    /// `Young's modulus` > 0 and -1 < `Poisson's ratio` < 0.5, both without default.
    void
    add_options(const Options &options);

    /// mu = E / (2 (1 + nu)) [Pa]
    double
    shear_modulus() const;

    /// lambda = E nu / ((1 + nu) (1 - 2 nu)) [Pa], Lame's first constant.
    double
    lame_modulus() const;

    /// K = lambda + 2/3 mu [Pa]
    double
    bulk_modulus() const;

    /// lambda + 2 mu [Pa]
    double
    p_wave_modulus() const;
  };
} // namespace undine

#endif
