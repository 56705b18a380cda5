// SPDX-License-Identifier: LGPL-2.1-or-later
#include "reference_table.h"
#include "solid_scene.h"

#include <catch2/catch.hpp>

using namespace undine_tests;

namespace
{
  /// The flag of Turek and Hron: its left end follows the cylinder.
  std::string
  flag(const double youngs_modulus)
  {
    return one_body(
      fmt::format("set Lower corner = 0, 0.19\n set Upper corner = 0.6, 0.21\n set Cells = 18, 1\n"
                  "set Map = 0.2+sqrt(0.0025-(y-0.2)^2)+x/0.6*(0.4-sqrt(0.0025-(y-0.2)^2)); y\n"
                  "set Refinements = 2\n set Density = 1000\n"
                  "set Material = Saint Venant-Kirchhoff\n set Young's modulus = {}\n"
                  "set Poisson's ratio = 0.4",
                  youngs_modulus),
      boundary("root", "set Sides = left"),
      "",
      "set Integrator = static");
  }


  /// Cook's membrane in m and N, a traction of 100 N per mm of thickness in all.
  std::string
  cook(const std::string &material, const unsigned int cells, const unsigned int degree)
  {
    return one_body(fmt::format("set Cells = {0}, {0}\n"
                                "set Map = 0.048*x; 0.044*x+y*(0.044-0.028*x)\n"
                                "set Density = 1000\n {1}",
                                cells,
                                material),
                    boundary("wall", "set Sides = left") +
                      boundary("edge",
                               "set Sides = right\n set Kind = traction\n"
                               "set Traction = 0; t*100e3/0.016"),
                    fmt::format("set Element degree = {}", degree),
                    "set Integrator = static");
  }


  std::string
  elastic_body(const std::string &name, const double shear_modulus, const double bulk_modulus)
  {
    return fmt::format("set Material = {}\n set Young's modulus = {:.16g}\n"
                       "set Poisson's ratio = {:.16g}",
                       name,
                       9 * bulk_modulus * shear_modulus / (3 * bulk_modulus + shear_modulus),
                       (3 * bulk_modulus - 2 * shear_modulus) /
                         (2 * (3 * bulk_modulus + shear_modulus)));
  }


  /// Deflection of the upper right corner [mm].
  double
  cook_deflection(const std::string &text)
  {
    Solid<2> solid(text);
    for (unsigned int step = 0; step < 4; ++step)
      solid.advance(0.25);
    return 1000 * solid.displacement({0.048, 0.060})[1];
  }
} // namespace


TEST_CASE("the flag of Turek and Hron bends under gravity as published", "[solid]")
{
  SolidEnvironment<2> gravity;
  gravity.gravity[1] = -2;
  struct Case
  {
    std::string name;
    double      youngs_modulus;
  };
  for (const auto &test : {Case{"CSM1", 1.4e6}, Case{"CSM2", 5.6e6}})
    {
      const auto published =
        reference_row("turek_hron_csm", {{"case", test.name}, {"level", "5+1"}});
      Solid<2> solid(flag(test.youngs_modulus), gravity);
      solid.advance(1);
      const auto tip = solid.displacement({0.6, 0.2});
      CHECK(tip[0] == Approx(number(published, "ux_mean_m")).epsilon(0.005));
      CHECK(tip[1] == Approx(number(published, "uy_mean_m")).epsilon(0.005));

      const auto mass = measure_bodies(solid.model, solid.state.displacement)[0].mass;
      CHECK(solid.column("reaction body/root y") == Approx(2 * mass));
      CHECK(std::abs(solid.column("reaction body/root x")) < 1e-8 * mass);
    }
}


TEST_CASE("Cook's membrane, nearly incompressible, does not lock", "[solid]")
{
  // 6.93 mm is where the reference's meshes converge to; plain bilinear elements give 4.7.
  const auto rubber = elastic_body("nearly incompressible rubber", 80.1938e6, 400942e6);
  CHECK(cook_deflection(cook(rubber, 16, 2)) == Approx(6.93).epsilon(0.01));
  const double bilinear = cook_deflection(cook(rubber, 30, 1));
  CHECK(bilinear == Approx(6.891).epsilon(0.005)); // as F-bar elements on the same mesh
  const auto reference =
    reference_row("cook_membrane", {{"case", "NI"}, {"source", "own FEM"}, {"mesh", "8"}});
  CHECK(cook_deflection(cook(rubber, 8, 2)) ==
        Approx(number(reference, "uy_corner_mm")).epsilon(0.001));
}


TEST_CASE("Cook's membrane of linear material", "[solid]")
{
  const auto material  = "set Material = linear elastic\n set Young's modulus = 70e6\n"
                         "set Poisson's ratio = 1/3";
  const auto reference = reference_row("cook_membrane", {{"case", "L"}});
  CHECK(cook_deflection(cook(material, 32, 2)) ==
        Approx(number(reference, "uy_corner_mm")).epsilon(0.002));
}


TEST_CASE("rollers hold one direction: a bar pulled contracts by Poisson's ratio", "[solid][mpi]")
{
  Solid<2> solid(one_body("set Upper corner = 2, 1\n set Cells = 4, 3\n set Density = 1\n"
                          "set Material = linear elastic\n set Young's modulus = 10\n"
                          "set Poisson's ratio = 0.3\n set Plane state = plane stress",
                          boundary("left", "set Sides = left\n set Components = x") +
                            boundary("floor", "set Sides = bottom\n set Components = y") +
                            boundary("right",
                                     "set Sides = right\n set Components = x\n"
                                     "set Kind = prescribed motion\n set Displacement = 0.02*t; 0"),
                          "",
                          "set Integrator = static"));
  solid.advance(1);
  CHECK(solid.displacement({2, 1})[0] == Approx(0.02));
  CHECK(solid.displacement({2, 1})[1] == Approx(-0.3 * 0.01));
  CHECK(solid.column("reaction body/right x") == Approx(10 * 0.01));
  CHECK(solid.column("reaction body/left x") == Approx(-10 * 0.01));
  CHECK(std::abs(solid.column("reaction body/floor y")) < 1e-12);
}


TEST_CASE("A soft body is as accurate beside a stiff one as alone", "[solid][mpi]")
{
  // The weight of the beam is 10^-9 of the forces in the block.
  const std::string beam = "subsection body\n set Upper corner = 1, 0.05\n set Cells = 20, 1\n"
                           "set Density = 1\n set Young's modulus = 2000\n set Poisson's ratio = "
                           "0.3\n set Load = 0; -10*t\n"
                           "subsection Boundaries\n" +
                           boundary("root", "set Sides = left") + "end\nend\n";
  const std::string block =
    "subsection block\n set Lower corner = 0, 2\n"
    "set Upper corner = 1, 3\n set Cells = 4, 4\n set Density = 7800\n"
    "set Young's modulus = 2e11\n set Poisson's ratio = 0.3\n subsection Boundaries\n" +
    boundary("root", "set Sides = left") +
    boundary("pull",
             "set Sides = right\n set Kind = traction\n"
             "set Traction = 2e9; 0") +
    "end\nend\n";
  const auto tip = [](const std::string &bodies) {
    Solid<2> solid("subsection Bodies\n" + bodies +
                   "end\nsubsection Time\n set Integrator = static\nend\n");
    for (int step = 0; step < 4; ++step)
      solid.advance(0.25);
    return solid.displacement({1, 0});
  };
  const auto alone = tip(beam), beside = tip(beam + block);
  CHECK(alone[0] < -0.5);
  CHECK((beside - alone).norm() < 1e-4 * alone.norm());
}
