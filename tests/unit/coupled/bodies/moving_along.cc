// SPDX-License-Identifier: LGPL-2.1-or-later
#include <coupled/coupled_run.h>
#include <coupled/obstacles/uniform_stream.h>

using namespace undine_tests;

namespace
{
  /// A free body of the speed of the stream around it: nothing acts on anything.
  template <int dim>
  void
  check_moving_along(const UniformStream<dim> &stream,
                     const std::string        &scheme,
                     const std::string        &shape,
                     const std::string        &form)
  {
    INFO(dim << "D, " << scheme << ", " << shape << ", " << form);
    CoupledRun<dim> run("set Scheme = " + scheme + "\n" + steps_of(stream.dt) + stream.fluid() +
                        section("Bodies",
                                body("thing",
                                     shape + "\nset Initial velocity = " + stream.vector() +
                                       "\nset Density = 300\nset Young's modulus = 1e5\nset "
                                       "Poisson's ratio = 0.3")) +
                        section("Effects", form));
    const double    speed = stream.velocity.norm();
    // Friction is solved for to a tolerance of its own.
    const double little = form.find("viscosity") == std::string::npos ? 1e-11 : 1e-8;
    for (unsigned int n = 0; n < 6; ++n)
      {
        run.step();
        REQUIRE(run.column("Flagged cells") == 0);
        REQUIRE(largest_on_faces(run.state.fluid.velocity,
                                 [&](const double value, const auto &, const unsigned int axis) {
                                   return std::abs(value - stream.velocity[axis]);
                                 }) <= little * speed);
        // The pressure that would stop the stream within one cell and step.
        REQUIRE(largest_in_cells(run.state.fluid.pressure, [](const double value, const auto &) {
                  return std::abs(value);
                }) <= little * 1000 * speed / 8 / stream.dt);
        for (const auto dof : run.models.solid->locally_owned())
          REQUIRE(std::abs(run.state.solid.velocity(dof) -
                           stream.velocity[run.models.solid->axis(dof)]) <= little * speed);
      }
  }


  template <int dim>
  void
  check_schemes(const std::string &shape)
  {
    const auto stream = UniformStream<dim>({{.7, .2, .1}}, .05).through();
    for (const auto &form : {convection(), flux_form()})
      {
        for (const std::string scheme : {"simultaneous", "time_splitting"})
          check_moving_along(stream, scheme, shape, form);
        check_moving_along(stream, "simultaneous", shape, form + viscosity(10));
      }
  }
} // namespace


TEST_CASE("A free body that moves along with a stream feels nothing", "[coupled][mpi]")
{
  SECTION("2D, ball")
  {
    check_schemes<2>("set Shape = ball\nset Centre = .8, .45\nset Radius = .2");
  }
  SECTION("2D, sheet")
  {
    check_schemes<2>(
      "set Shape = box\nset Lower corner = .7, .3\nset Upper corner = .7001, .6\nset Cells = 1, 3");
  }
  SECTION("3D, ball")
  {
    check_schemes<3>("set Shape = ball\nset Centre = .8, .45, .5\nset Radius = .2");
  }
}
