// SPDX-License-Identifier: LGPL-2.1-or-later
// What every registered material has to fulfil. A new law is covered without a change here.
#include <undine/base/core/errors.h>
#include <undine/solid/material/elastic_constants.h>
#include <undine/solid/material/material.h>

#include <catch2/catch.hpp>
#include <solid/material_samples.h>

#include <cmath>
#include <string>

using namespace undine;
using namespace undine::samples;
using dealii::Tensor;

namespace
{
  const unsigned int n_samples = 20;

  const Tensor<2, 3> identity = dealii::unit_symmetric_tensor<3>();


  template <class Check>
  void
  for_every_material(const Check &check)
  {
    REQUIRE(Registry<Material>::instance().names().size() >= 4);
    for (const auto &name : Registry<Material>::instance().names())
      for (const ElasticConstants constants :
           {ElasticConstants{3e5, 0.3}, ElasticConstants{2., 0.}, ElasticConstants{1e3, 0.49}})
        DYNAMIC_SECTION(name << ", nu = " << constants.poissons_ratio)
        {
          check(*make_material(name, constants), constants);
        }
  }
} // namespace


TEST_CASE("material: stress is the derivative of energy, tangent that of stress", "[material]")
{
  for_every_material([](const Material &material, const ElasticConstants &constants) {
    Generator    generator;
    const double tolerance = 1e-7 * constants.p_wave_modulus();
    for (unsigned int sample = 0; sample < n_samples; ++sample)
      {
        const auto F = generator.deformation_gradient();
        const auto P =
          gradient_by_differences(F, [&](const auto &G) { return material.energy(G); });
        CHECK((material.stress(F) - P).norm() < tolerance);
        const auto A = tangent_by_differences(F, [&](const auto &G) { return material.stress(G); });
        CHECK((material.tangent(F) - A).norm() < tolerance);
        CHECK(asymmetry(material.tangent(F)) < 1e-12 * constants.p_wave_modulus());
      }
  });
}


TEST_CASE("material: U' and U'' are the derivatives of U", "[material]")
{
  for_every_material([](const Material &material, const ElasticConstants &constants) {
    const double tolerance = 1e-7 * constants.p_wave_modulus();
    const double step      = 1e-5;
    for (const double J : {0.5, 0.8, 1., 1.3, 2.})
      {
        const double stress =
          (material.volumetric_energy(J + step) - material.volumetric_energy(J - step)) /
          (2 * step);
        CHECK(std::abs(material.volumetric_stress(J) - stress) < tolerance);
        const double tangent =
          (material.volumetric_stress(J + step) - material.volumetric_stress(J - step)) /
          (2 * step);
        CHECK(std::abs(material.volumetric_tangent(J) - tangent) < tolerance);
        CHECK((material.volumetric_tangent(J) != 0) == material.has_separate_volumetric_part());
      }
  });
}


TEST_CASE("material: the energy of small strains is Hooke's", "[material]")
{
  for_every_material([](const Material &material, const ElasticConstants &constants) {
    const auto hooke = make_material("linear elastic", constants);
    Generator  generator;
    for (unsigned int sample = 0; sample < n_samples; ++sample)
      {
        const Tensor<2, 3> F = identity + 1e-7 * (generator.deformation_gradient() - identity);
        // Terms of third order are 1e-7 of it, what differences with 1 lose is 1e-2.
        CHECK(material.energy(F) + material.volumetric_energy(determinant(F)) ==
              Approx(hooke->energy(F)).epsilon(1e-5));
      }
  });
}


TEST_CASE("material: rest is free of stress and has the isotropic tangent", "[material]")
{
  for_every_material([](const Material &material, const ElasticConstants &constants) {
    const double scale = constants.p_wave_modulus();
    CHECK(std::abs(material.energy(identity)) < 1e-14 * scale);
    CHECK(material.stress(identity).norm() < 1e-14 * scale);
    CHECK(material.volumetric_energy(1) == 0);
    CHECK(material.volumetric_stress(1) == 0);
    CHECK(material.p_wave_modulus() == Approx(scale));

    // At rest dJ/dF = I, and the part with U' vanishes.
    const auto A = material.tangent(identity) +
                   material.volumetric_tangent(1) * outer_product(identity, identity);
    const auto expected = isotropic_tangent<3>(constants.lame_modulus(), constants.shear_modulus());
    CHECK((A - expected).norm() < 1e-13 * scale);
  });
}


TEST_CASE("material: a rotation of the body rotates the stress, nothing else", "[material]")
{
  for_every_material([](const Material &material, const ElasticConstants &constants) {
    Generator    generator;
    const double tolerance = 1e-12 * constants.p_wave_modulus();
    double       defect    = 0;
    for (unsigned int sample = 0; sample < n_samples; ++sample)
      {
        const auto F = generator.deformation_gradient();
        const auto Q = generator.rotation();
        REQUIRE((Q * transpose(Q) - identity).norm() < 1e-14);
        REQUIRE(determinant(Q) > 0);
        defect = std::max(defect, std::abs(material.energy(Q * F) - material.energy(F)));
        defect = std::max(defect, (material.stress(Q * F) - Q * material.stress(F)).norm());
      }
    // A law that says it is not objective must not be: the word would mean nothing.
    CHECK((defect < tolerance) == material.is_objective());
  });
}


TEST_CASE("material: no law returns not-a-number for an inverted element", "[material]")
{
  for_every_material([](const Material &material, const ElasticConstants &) {
    for (const double stretch : {-1., 0.})
      {
        auto F                     = identity;
        F[0][0]                    = stretch;
        const auto finite_or_error = [&](const auto &function) {
          try
            {
              const double value = function();
              CHECK(std::isfinite(value));
            }
          catch (const SolveError &error)
            {
              CHECK_FALSE(material.tolerates_inversion());
              CHECK(std::string(error.what()).find("det F") != std::string::npos);
            }
        };
        finite_or_error([&] { return material.energy(F); });
        finite_or_error([&] { return material.stress(F).norm(); });
        finite_or_error([&] { return material.tangent(F).norm(); });
      }
  });
}


TEST_CASE("material: constants must be given and lie in their range", "[material]")
{
  for (const auto &name : Registry<Material>::instance().names())
    {
      const auto refused = [&](const std::string &youngs_modulus,
                               const std::string &poissons_ratio) {
        ParameterFile file;
        if (!youngs_modulus.empty())
          file.set("Young's modulus=" + youngs_modulus);
        if (!poissons_ratio.empty())
          file.set("Poisson's ratio=" + poissons_ratio);
        try
          {
            Registry<Material>::instance().make(name)->add_options(Options(file));
          }
        catch (const InputError &error)
          {
            return std::string(error.what());
          }
        return std::string();
      };
      INFO(name);
      CHECK(refused("1e6", "0.4").empty());
      CHECK(refused("1e6", "0.4999").empty());
      CHECK(refused("", "0.4").find("'Young's modulus'") != std::string::npos);
      CHECK(refused("1e6", "").find("'Poisson's ratio'") != std::string::npos);
      CHECK(refused("0", "0.4").find("> 0 [Pa]") != std::string::npos);
      CHECK(refused("1e6", "0.5").find("> -1 and < 0.5") != std::string::npos);
      CHECK(refused("1e6", "-1").find("> -1 and < 0.5") != std::string::npos);
    }
}
