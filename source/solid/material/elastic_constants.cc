// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/solid/material/elastic_constants.h>

namespace undine
{
  void
  ElasticConstants::add_options(const Options &options)
  {
    options.require("Young's modulus",
                    youngs_modulus,
                    "Pa",
                    Allowed::positive(),
                    "Stress per strain of a bar pulled along its axis, at rest.");
    const Allowed poisson_range{
      "> -1 and < 0.5", [](const double value) { return value > -1 && value < 0.5; }, {}};
    options.require(
      "Poisson's ratio",
      poissons_ratio,
      "1",
      poisson_range,
      "Lateral contraction per stretch of a bar pulled along its axis, at rest. Above "
      "0.45 use a nearly incompressible 'Material': the others lock.");
  }


  double
  ElasticConstants::shear_modulus() const
  {
    return youngs_modulus / (2 * (1 + poissons_ratio));
  }


  double
  ElasticConstants::lame_modulus() const
  {
    return youngs_modulus * poissons_ratio / ((1 + poissons_ratio) * (1 - 2 * poissons_ratio));
  }


  double
  ElasticConstants::bulk_modulus() const
  {
    return lame_modulus() + 2. / 3. * shear_modulus();
  }


  double
  ElasticConstants::p_wave_modulus() const
  {
    return lame_modulus() + 2 * shear_modulus();
  }
} // namespace undine
