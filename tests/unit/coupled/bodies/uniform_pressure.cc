// SPDX-License-Identifier: LGPL-2.1-or-later
#include <coupled/coupled_run.h>

using namespace undine_tests;

namespace
{
  constexpr double pressure = 1, size = .2, modulus = 1e6, poisson = .3;

  /// A square or a cube in the lower corner of a fluid of one pressure, on sides along which it
  /// slides.
  template <int dim>
  std::string
  squeezed(const unsigned int degree, const unsigned int cells)
  {
    const auto all = [](const auto &value) {
      return fmt::format(plane_or_space<dim>("{0}, {0}", "{0}, {0}, {0}"), value);
    };
    const auto slides = [](const std::string &axis, const std::string &side) {
      return clamp("slides_" + axis, "1", "set Sides = " + side + "\nset Components = " + axis);
    };
    // So long that inertia does not matter: the limit is the place of rest.
    return steps_of(1000) + section("Time", "set Integrator = static") +
           section("Domain",
                   "set Lower corner = " + all(0) + "\nset Upper corner = " + all(.47) +
                     "\nset Cells = " + all(6)) +
           section("Fluid",
                   "set Density = 1000\n" +
                     section("Boundaries",
                             boundary("openings",
                                      "right, top" + plane_or_space<dim>("", ", front"),
                                      "pressure",
                                      "set Pressure = " + std::to_string(pressure)))) +
           section("Bodies",
                   body("cube",
                        "set Lower corner = " + all(0) + "\nset Upper corner = " + all(size) +
                          "\nset Cells = " + all(cells) +
                          fmt::format("\nset Density = 1000\nset Material = linear elastic\nset "
                                      "Young's modulus = {}\nset Poisson's ratio = {}",
                                      modulus,
                                      poisson),
                        slides("x", "left") + slides("y", "bottom") +
                          plane_or_space<dim>("", slides("z", "back")))) +
           section("Coupling", "set Boundary flux = swept") +
           section("Solid numerics", "set Element degree = " + std::to_string(degree));
  }


  /// Hooke's law, plane strain in 2D: every element has the same strain, also at its surface.
  template <int dim>
  void
  check_strain(const unsigned int degree, const unsigned int cells)
  {
    INFO(dim << "D, degree " << degree << ", " << cells << " cells an edge");
    CoupledRun<dim> run(squeezed<dim>(degree, cells));
    for (unsigned int n = 0; n < 4; ++n)
      run.step();
    const double strain = -pressure / modulus * (1 - 2 * poisson) * (dim == 2 ? 1 + poisson : 1);
    const double volume = std::pow(size, dim);
    CHECK(run.column("solid elastic energy") ==
          Approx(-dim * pressure * strain * volume / 2).epsilon(1e-4));
    const auto &solid = *run.models.solid;
    for (const auto dof : solid.locally_owned())
      REQUIRE(std::abs(run.state.solid.displacement(dof) -
                       strain * solid.rest_position(dof)[solid.axis(dof)]) <=
              1e-4 * std::abs(strain) * size);
  }
} // namespace


TEST_CASE("A uniform pressure strains elements of both degrees uniformly", "[coupled][mpi]")
{
  for (const unsigned int degree : {1, 2})
    for (const unsigned int cells : {1, 2})
      {
        check_strain<2>(degree, cells);
        check_strain<3>(degree, cells);
      }
}
