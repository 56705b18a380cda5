// SPDX-License-Identifier: LGPL-2.1-or-later
// What every way of embedding a body in space has to fulfil with every material.
#include <undine/base/core/errors.h>
#include <undine/solid/material/elastic_constants.h>
#include <undine/solid/material/kinematics.h>

#include <catch2/catch.hpp>
#include <solid/material_samples.h>

#include <cmath>
#include <limits>

using namespace undine;
using namespace undine::samples;
using dealii::Tensor;

namespace
{
  const ElasticConstants constants{3e5, 0.3};
  const double           E  = constants.youngs_modulus;
  const double           nu = constants.poissons_ratio;

  const auto material_names = [] { return Registry<Material>::instance().names(); };


  std::unique_ptr<Kinematics<2>>
  plane(const std::string &state)
  {
    return choose_kinematics<2>(elastic_options(constants, state));
  }


  template <int dim>
  void
  check_derivatives(const Kinematics<dim> &kinematics, const Material &material)
  {
    Generator    generator;
    const double scale = constants.p_wave_modulus();
    for (unsigned int sample = 0; sample < 10; ++sample)
      {
        const auto H        = generator.template displacement_gradient<dim>();
        const auto response = kinematics.respond(material, H);
        const auto point    = kinematics.stress(material, H);
        CHECK((response.stress - point.stress).norm() == 0);
        CHECK(response.jacobian == point.jacobian);
        CHECK(response.thickness_stretch == point.thickness_stretch);
        const auto in_plane = determinant(dealii::unit_symmetric_tensor<dim>() + H);
        CHECK(point.jacobian == Approx(in_plane * point.thickness_stretch));

        const auto P =
          gradient_by_differences(H, [&](const auto &G) { return kinematics.energy(material, G); });
        CHECK((point.stress - P).norm() < 1e-7 * scale);
        const auto A = tangent_by_differences(
          H, [&](const auto &G) { return kinematics.stress(material, G).stress; });
        CHECK((response.tangent - A).norm() < 1e-7 * scale);
        CHECK(asymmetry(response.tangent) < 1e-12 * scale);
      }
  }


  /// The whole P, with the part of U, of a sheet whose F_33 is known.
  Tensor<2, 3>
  sheet_stress(const Material &material, const Tensor<2, 2> &H, const double thickness_stretch)
  {
    Tensor<2, 3> F;
    for (unsigned int i = 0; i < 2; ++i)
      for (unsigned int j = 0; j < 2; ++j)
        F[i][j] = (i == j) + H[i][j];
    F[2][2] = thickness_stretch;
    return material.stress(F) + material.volumetric_stress(determinant(F)) * cofactor(F);
  }
} // namespace


TEST_CASE("kinematics: stress and tangent are derivatives of the energy", "[kinematics]")
{
  for (const auto &name : material_names())
    {
      const auto material = make_material(name, constants);
      for (const auto &state : Registry<Kinematics<2>>::instance().names())
        DYNAMIC_SECTION(name << ", " << state)
        {
          check_derivatives<2>(*plane(state), *material);
        }
      DYNAMIC_SECTION(name << ", 3D")
      {
        check_derivatives<3>(*choose_kinematics<3>(elastic_options(constants)), *material);
      }
    }
}


TEST_CASE("kinematics: plane strain is 3D with nothing across the plane", "[kinematics]")
{
  const auto in_plane = plane("plane strain");
  const auto in_space = choose_kinematics<3>(elastic_options(constants));
  for (const auto &name : material_names())
    {
      const auto   material = make_material(name, constants);
      Generator    generator;
      const auto   H = generator.displacement_gradient<2>();
      Tensor<2, 3> G;
      for (unsigned int i = 0; i < 2; ++i)
        for (unsigned int j = 0; j < 2; ++j)
          G[i][j] = H[i][j];
      const auto flat    = in_plane->respond(*material, H);
      const auto spatial = in_space->respond(*material, G);
      for (unsigned int i = 0; i < 2; ++i)
        for (unsigned int j = 0; j < 2; ++j)
          {
            CHECK(flat.stress[i][j] == spatial.stress[i][j]);
            for (unsigned int k = 0; k < 2; ++k)
              for (unsigned int l = 0; l < 2; ++l)
                CHECK(flat.tangent[i][j][k][l] == spatial.tangent[i][j][k][l]);
          }
      CHECK(flat.thickness_stretch == 1);
      CHECK(in_plane->separates_volumetric_part(*material) ==
            material->has_separate_volumetric_part());
    }
}


TEST_CASE("plane stress: nothing presses on the sheet", "[kinematics]")
{
  const auto kinematics = plane("plane stress");
  for (const auto &name : material_names())
    for (const double ratio : {0., 0.3, 0.4999})
      DYNAMIC_SECTION(name << ", nu = " << ratio)
      {
        const ElasticConstants sheet{E, ratio};
        const auto             material = make_material(name, sheet);
        CHECK_FALSE(kinematics->separates_volumetric_part(*material));
        Generator generator;
        for (unsigned int sample = 0; sample < 10; ++sample)
          {
            const auto H     = 0.6 * generator.displacement_gradient<2>();
            const auto point = kinematics->stress(*material, H);
            const auto P     = sheet_stress(*material, H, point.thickness_stretch);
            CHECK(std::abs(P[2][2]) < 1e-12 * sheet.p_wave_modulus());
            for (unsigned int i = 0; i < 2; ++i)
              for (unsigned int j = 0; j < 2; ++j)
                CHECK(std::abs(P[i][j] - point.stress[i][j]) < 1e-12 * sheet.p_wave_modulus());
          }
      }
}


TEST_CASE("plane stress: moduli of a sheet at rest", "[kinematics]")
{
  const auto kinematics = plane("plane stress");
  for (const auto &name : material_names())
    {
      INFO(name);
      const auto   material   = make_material(name, constants);
      const auto   A          = kinematics->respond(*material, Tensor<2, 2>()).tangent;
      const double sheet_lame = E * nu / (1 - nu * nu);
      const auto   expected   = isotropic_tangent<2>(sheet_lame, constants.shear_modulus());
      CHECK((A - expected).norm() < 1e-12 * E);
      CHECK(A[0][0][0][0] == Approx(E / (1 - nu * nu)).epsilon(1e-12));
      // Pulled with free sides: Young's modulus.
      CHECK(A[0][0][0][0] - A[0][0][1][1] * A[1][1][0][0] / A[1][1][1][1] ==
            Approx(E).epsilon(1e-12));

      const auto thickness = [&](const double strain) {
        Tensor<2, 2> H;
        H[0][0] = strain;
        return kinematics->stress(*material, H).thickness_stretch;
      };
      const double step = 1e-5;
      CHECK((thickness(step) - thickness(-step)) / (2 * step) ==
            Approx(-nu / (1 - nu)).epsilon(1e-6));
    }
}


TEST_CASE("plane stress: a rubber band pulled to twice its length", "[kinematics]")
{
  // Incompressible, uniaxial: P = G (s - s^-2), and the sides contract by s^-1/2.
  const ElasticConstants rubber{3e5, 0.499999};
  const auto             material   = make_material("nearly incompressible rubber", rubber);
  const auto             kinematics = plane("plane stress");
  for (const double stretch : {0.5, 1.5, 2.})
    {
      Tensor<2, 2> H;
      H[0][0]            = stretch - 1;
      H[1][1]            = 1 / std::sqrt(stretch) - 1;
      const auto   point = kinematics->stress(*material, H);
      const double P     = rubber.shear_modulus() * (stretch - 1 / (stretch * stretch));
      CHECK(point.stress[0][0] == Approx(P).epsilon(1e-4));
      CHECK(std::abs(point.stress[1][1]) < 1e-4 * std::abs(P));
      CHECK(point.jacobian == Approx(1).epsilon(1e-4));
    }
}


TEST_CASE("plane stress: the neo-Hookean thickness is found at any stretch", "[kinematics]")
{
  const auto material   = make_material("neo-Hookean", constants);
  const auto kinematics = plane("plane stress");
  for (const double stretch : {0.05, 0.2, 5., 20.})
    {
      const auto H     = (stretch - 1) * Tensor<2, 2>(dealii::unit_symmetric_tensor<2>());
      const auto point = kinematics->stress(*material, H);
      const auto P     = sheet_stress(*material, H, point.thickness_stretch);
      CHECK(std::abs(P[2][2]) < 1e-10 * P.norm());
      CHECK(point.thickness_stretch > 0);
    }
}


TEST_CASE("plane stress: a Saint Venant-Kirchhoff sheet has a largest stretch", "[kinematics]")
{
  // F_33^2 = 1 - 2 nu/(1-nu) (E_11 + E_22) = 1 - nu/(1-nu) 2 (s^2 - 1)
  const auto   material   = make_material("Saint Venant-Kirchhoff", constants);
  const auto   kinematics = plane("plane stress");
  const double limit      = std::sqrt(1 + (1 - nu) / (2 * nu));
  const auto   stretched  = [&](const double stretch) {
    const auto H = (stretch - 1) * Tensor<2, 2>(dealii::unit_symmetric_tensor<2>());
    return kinematics->respond(*material, H).thickness_stretch;
  };
  const double near = 0.999 * limit;
  CHECK(stretched(near) == Approx(std::sqrt(1 - 2 * nu / (1 - nu) * (near * near - 1))));
  CHECK_THROWS_AS(stretched(1.001 * limit), SolveError);
}


TEST_CASE("kinematics: inversion and not-a-number are errors, not numbers", "[kinematics]")
{
  const double not_a_number = std::numeric_limits<double>::quiet_NaN();
  for (const auto &state : Registry<Kinematics<2>>::instance().names())
    for (const auto &name : material_names())
      {
        INFO(name << ", " << state);
        const auto   kinematics = plane(state);
        const auto   material   = make_material(name, constants);
        Tensor<2, 2> inverted;
        inverted[0][0] = -1.5;
        if (material->tolerates_inversion())
          {
            CHECK(std::isfinite(kinematics->respond(*material, inverted).tangent.norm()));
            continue;
          }
        Tensor<2, 2> broken;
        broken[1][0] = broken[0][1] = not_a_number;
        for (const auto &H : {inverted, broken})
          {
            CHECK_THROWS_AS(kinematics->respond(*material, H), SolveError);
            CHECK_THROWS_AS(kinematics->stress(*material, H), SolveError);
            CHECK_THROWS_AS(kinematics->energy(*material, H), SolveError);
          }
      }
}


TEST_CASE("kinematics: an unknown plane state is refused with the known ones", "[kinematics]")
{
  CHECK_THROWS_WITH(plane("plain strain"),
                    Catch::Contains("'Plane state'") && Catch::Contains("plane strain") &&
                      Catch::Contains("plane stress"));
}
