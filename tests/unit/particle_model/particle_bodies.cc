// SPDX-License-Identifier: LGPL-2.1-or-later
#include <catch2/catch.hpp>
#include <message_of.h>

#include "particle_scene.h"

#include <undine/particles/elasticity/elastic_law.h>

#include <solid/material_samples.h>

#include <cmath>

using namespace undine_tests;
using undine::particles::ElasticLaw;
using undine::particles::ElasticMaterial;
using undine::particles::Law;

namespace
{
  std::string
  one_body(const std::string &keys, const std::string &boundary = "")
  {
    return section(
      "Bodies",
      section("block",
              "set Density = 700\n set Young's modulus = 2e5\n set Poisson's ratio = "
              "0.4\n" +
                keys + "\n" +
                (boundary.empty() ? "" : section("Boundaries", section("held", boundary)))));
  }


  template <int dim>
  void
  check_stress(const std::string &word, const Law law)
  {
    ElasticConstants constants;
    constants.youngs_modulus               = 3;
    constants.poissons_ratio               = .4;
    const auto                    material = undine::samples::make_material(word, constants);
    const ElasticMaterial<double> of_particles{
      constants.lame_modulus(), constants.shear_modulus(), 1., 1., 0., 0., 1., 0., 0., law};
    const ElasticLaw<dim, double>  particle_law{of_particles};
    particles::Matrix<dim, double> F = particles::Matrix<dim, double>::diagonal(1.1);
    undine::Material::Gradient     whole;
    whole[2][2] = 1;
    for (int a = 0; a < dim; ++a)
      for (int b = 0; b < dim; ++b)
        whole[a][b] = F[a][b] += .1 * std::sin(1 + a + 3 * b);
    const auto R = particle_law.rotation(F, F), D = particle_law.distortion_stress(F, R);
    const auto C = cofactors(F);
    auto       P = material->stress(whole);
    double     W = material->energy(whole);
    if (material->has_separate_volumetric_part())
      {
        const double J = determinant(whole);
        P += material->volumetric_stress(J) * cofactor(whole);
        W += material->volumetric_energy(J);
      }
    CHECK(particle_law.energy(F, R) == Approx(W));
    for (int a = 0; a < dim; ++a)
      for (int b = 0; b < dim; ++b)
        CHECK(D[a][b] + particle_law.tension(F) * C[a][b] == Approx(P[a][b]));
  }
} // namespace


TEMPLATE_TEST_CASE_SIG(
  "particles: laws have the stress and energy of finite elements", "", ((int dim), dim), 2, 3)
{
  check_stress<dim>("linear elastic", Law::linear_elastic);
  check_stress<dim>("Saint Venant-Kirchhoff", Law::saint_venant_kirchhoff);
  check_stress<dim>("neo-Hookean", Law::neo_hookean);
  check_stress<dim>("nearly incompressible rubber", Law::nearly_incompressible_rubber);
}


TEST_CASE("particles: bodies read their law, and the effect 'damping'")
{
  const std::string place = "set Centre = 5, 5\n set Size = 2, 2\n";
  const auto        plain = read_particles<2>(particle_box<2>(10) + one_body(place));
  CHECK(plain.setup().bodies[0].law == Law::corotated);
  CHECK(plain.setup().body_damping.stiffness == 0);
  const auto damped = read_particles<2>(
    particle_box<2>(10) + one_body(place + "set Material = linear elastic") +
    section("Effects",
            section("damping", "set Stiffness coefficient = 0.02\n set Mass coefficient = 3")));
  CHECK(damped.setup().bodies[0].law == Law::linear_elastic);
  CHECK(damped.setup().body_damping.stiffness == 0.02);
  CHECK(damped.setup().body_damping.mass == 3);
  CHECK_THAT(message_of([&] {
               read_particles<2>(particle_box<2>(10) + one_body(place + "set Material = wood"));
             }),
             Catch::Contains("'Material'") && Catch::Contains("neo-Hookean"));
}


TEST_CASE("particles: bodies start displaced, and their places then are checked")
{
  const std::string box   = "set Lower corner = 4, 4\n set Upper corner = 6, 7\n";
  const auto        model = read_particles<2>(
    particle_box<2>(10) +
    one_body(box + "set Initial displacement = 0.1*(x - 4); -0.2\n set Initial velocity = 1; 2",
             "set Sides = bottom\n set Components = y"));
  const auto &setup = model.setup();
  const auto &state = model.initial_state();
  for (std::size_t k = 0; k < setup.reference.size(); ++k)
    {
      const double x = setup.reference[k][0], y = setup.reference[k][1];
      CHECK(state.positions[k][0] == Approx(x + 0.1 * (x - 4)));
      CHECK(state.positions[k][1] == Approx(y - 0.2));
      CHECK(setup.clamped[k] == (y < 5 ? 2 : 0));
      CHECK(state.velocities[k][0] == 1);
      CHECK(state.velocities[k][1] == (y < 5 ? 0 : 2));
    }
  const auto message = [&](const std::string &displacement) {
    return message_of([&] {
      read_particles<2>(particle_box<2>(10) +
                        one_body(box + "set Initial displacement = " + displacement));
    });
  };
  CHECK_THAT(message("0; 4"), Catch::Contains("outside the domain"));
  CHECK_THAT(message("1/(x - 4.5); 0"),
             Catch::Contains("'Initial displacement'") && Catch::Contains("not a number"));
  CHECK_THAT(message("2*(5 - x); 0"), Catch::Contains("inside out"));
}


TEST_CASE("particles: the side of a shape with a map is clamped where the map has it")
{
  const auto model =
    read_particles<2>(particle_box<2>(12) +
                      one_body("set Lower corner = 2, 4\n set Upper corner = 9, 8\n set Map = x - "
                               "(4 - sqrt(16 - (y - 6)^2))*(9 - x)/7; y",
                               "set Sides = left"));
  const auto &setup = model.setup();
  int         held  = 0;
  for (std::size_t k = 0; k < setup.reference.size(); ++k)
    {
      const double from_arc = std::hypot(setup.reference[k][0] + 2, setup.reference[k][1] - 6) - 4;
      CHECK(from_arc > -.02);
      CHECK(setup.clamped[k] == (from_arc < 1 ? undine::particles::all_directions<2> : 0));
      held += setup.clamped[k] != 0;
    }
  CHECK(held >= 4);
}
