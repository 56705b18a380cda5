// SPDX-License-Identifier: LGPL-2.1-or-later
// Closed solutions of single laws.
#include <undine/solid/material/elastic_constants.h>
#include <undine/solid/material/material.h>

#include <catch2/catch.hpp>
#include <solid/material_samples.h>

#include <cmath>

using namespace undine;
using namespace undine::samples;
using dealii::Tensor;

namespace
{
  const ElasticConstants stiff_constants{1e6, 0.35};

  const double lambda = stiff_constants.lame_modulus();
  const double mu     = stiff_constants.shear_modulus();

  const Tensor<2, 3> unit_tensor = dealii::unit_symmetric_tensor<3>();
} // namespace


TEST_CASE("elastic constants agree with each other", "[material]")
{
  CHECK(stiff_constants.youngs_modulus == Approx(mu * (3 * lambda + 2 * mu) / (lambda + mu)));
  CHECK(stiff_constants.poissons_ratio == Approx(lambda / (2 * (lambda + mu))));
  CHECK(stiff_constants.bulk_modulus() ==
        Approx(stiff_constants.youngs_modulus / (3 * (1 - 2 * 0.35))));
  CHECK(stiff_constants.p_wave_modulus() == Approx(lambda + 2 * mu));
}


TEST_CASE("linear elastic: a sum of deformations gives the sum of stresses", "[material]")
{
  const auto material = make_material("linear elastic", stiff_constants);
  Generator  generator;
  const auto first    = generator.displacement_gradient<3>();
  const auto second   = generator.displacement_gradient<3>();
  const auto together = material->stress(unit_tensor + first - 3 * second);
  const auto apart =
    material->stress(unit_tensor + first) - 3 * material->stress(unit_tensor + second);
  CHECK((together - apart).norm() < 1e-13 * stiff_constants.p_wave_modulus());
}


TEST_CASE("Saint Venant-Kirchhoff: a bar stretched without contraction", "[material]")
{
  const auto material = make_material("Saint Venant-Kirchhoff", stiff_constants);
  for (const double stretch : {0.7, 1.4})
    {
      auto F              = unit_tensor;
      F[0][0]             = stretch;
      const double strain = 0.5 * (stretch * stretch - 1);
      const auto   P      = material->stress(F);
      CHECK(P[0][0] == Approx((lambda + 2 * mu) * strain * stretch));
      CHECK(P[1][1] == Approx(lambda * strain));
    }
}


TEST_CASE("neo-Hookean: simple shear", "[material]")
{
  const auto   material = make_material("neo-Hookean", stiff_constants);
  const double shear    = 0.8;
  auto         F        = unit_tensor;
  F[0][1]               = shear;
  const auto sigma      = material->stress(F) * transpose(F); // J = 1
  CHECK(sigma[0][1] == Approx(mu * shear));
  CHECK(sigma[0][0] - sigma[1][1] == Approx(mu * shear * shear));
  CHECK(std::abs(sigma[1][1]) < 1e-12 * mu);
}


TEST_CASE("neo-Hookean: no finite energy turns a volume into nothing or into infinity",
          "[material]")
{
  const auto material = make_material("neo-Hookean", stiff_constants);
  double     previous = 0;
  for (unsigned int i = 1; i < 6; ++i)
    {
      // Pressure rises without bound in compression and without softening in expansion.
      const double pressed = -material->stress(std::pow(0.5, i) * unit_tensor)[0][0];
      const double blown   = material->stress(std::pow(2., i) * unit_tensor)[0][0];
      CHECK(pressed > 2 * previous);
      CHECK(blown > 2 * previous);
      previous = std::min(pressed, blown);
    }
}


TEST_CASE("nearly incompressible rubber: stress does no work in pure dilatation", "[material]")
{
  const auto material = make_material("nearly incompressible rubber", stiff_constants);
  Generator  generator;
  for (unsigned int sample = 0; sample < 10; ++sample)
    {
      const auto   F = generator.deformation_gradient();
      const double s = generator.between(0.5, 2);
      CHECK(std::abs(scalar_product(material->stress(F), F)) < 1e-12 * mu);
      CHECK(material->energy(s * F) == Approx(material->energy(F)));
    }
}


TEST_CASE("nearly incompressible rubber: the law of the Cook membrane reference", "[material]")
{
  // Constants of the published case in N/mm^2, given there as shear and bulk modulus.
  const double           G = 80.1938, K = 400942;
  const ElasticConstants cook{9 * K * G / (3 * K + G), (3 * K - 2 * G) / (2 * (3 * K + G))};
  const auto             material = make_material("nearly incompressible rubber", cook);
  CHECK(cook.poissons_ratio == Approx(0.4999).epsilon(1e-6));

  Generator  generator;
  const auto F = generator.deformation_gradient();
  const auto J = determinant(F);
  const auto W = 0.5 * G * (std::pow(J, -2. / 3) * trace(transpose(F) * F) - 3);
  CHECK(material->energy(F) == Approx(W));
  CHECK(material->volumetric_energy(J) == Approx(0.5 * K * (J - 1) * (J - 1)).epsilon(1e-5));
}
