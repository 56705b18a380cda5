// SPDX-License-Identifier: LGPL-2.1-or-later
#include <coupled/obstacle_run.h>

using namespace undine_tests;

namespace
{
  template <int dim>
  struct Stream
  {
    dealii::Tensor<1, dim> velocity;
    double                 dt;

    std::string
    vector(const std::string &factor = "1") const
    {
      std::string result;
      for (unsigned int d = 0; d < dim; ++d)
        result += fmt::format("{}{:.17g}*{}", d == 0 ? "" : "; ", velocity[d], factor);
      return result;
    }

    /// In at the lower sides, out at the upper ones; one cell is 1/8 long.
    std::string
    fluid() const
    {
      return section("Domain",
                     plane_or_space<dim>("set Upper corner = 2, 1\nset Cells = 16, 8",
                                         "set Upper corner = 2, 1, 1\nset Cells = 16, 8, 8")) +
             section("Fluid",
                     "set Density = 1000\nset Initial velocity = " + vector() + "\n" +
                       section("Boundaries",
                               boundary("in",
                                        plane_or_space<dim>("left, bottom", "left, bottom, back"),
                                        "inflow",
                                        "set Velocity = " + vector()) +
                                 boundary("out",
                                          plane_or_space<dim>("right, top", "right, top, front"),
                                          "outflow")));
    }
  };


  /// A stream in which everything moves along stays what it is.
  template <int dim>
  void
  check_translation(const Stream<dim> &stream, const std::string &shape, const std::string &keys)
  {
    INFO(shape << " " << keys << ", in " << stream.vector());
    ObstacleRun<dim> run(
      stream.fluid(),
      obstacle("thing", shape, keys + "\nset Displacement = " + stream.vector("t")),
      convection() + section("scalar transport",
                             section("smoke", "set Initial value = 1\nset Inflow value = 1")),
      stream.dt);
    const double speed = stream.velocity.norm();
    for (unsigned int n = 0; n < 12; ++n)
      {
        run.step();
        REQUIRE(run.column("Flagged cells") == 0);
        REQUIRE(largest_on_faces(run.state.fluid.velocity,
                                 [&](const double value, const auto &, const unsigned int axis) {
                                   return std::abs(value - stream.velocity[axis]);
                                 }) <= 1e-12 * speed);
        // The pressure that would stop the stream within one cell and step.
        REQUIRE(largest_in_cells(run.state.fluid.pressure, [](const double value, const auto &) {
                  return std::abs(value);
                }) <= 1e-12 * 1000 * speed / 8 / stream.dt);
        REQUIRE(run.column("Fluid divergence") <= 1e-12);
        REQUIRE(largest_in_cells(
                  run.state.fluid.scalars.at("smoke"),
                  [](const double value, const auto &) { return std::abs(value - 1); }) <= 1e-12);
      }
  }


  template <int dim>
  Stream<dim>
  stream(const std::array<double, 3> &velocity, const double dt)
  {
    Stream<dim> result{{}, dt};
    for (unsigned int d = 0; d < dim; ++d)
      result.velocity[d] = velocity[d];
    return result;
  }


  template <int dim>
  std::string
  sheet(const double thickness, const double x, const double angle)
  {
    return fmt::format(
      plane_or_space<dim>(
        "set Centre = {}, .5\nset Size = {}, .5\nset Rotation = {}\nset Cells = 1, 3",
        "set Centre = {}, .5, .5\nset Size = {}, .5, .5\nset Rotation = 20, 30, "
        "{}\nset Cells = 1, 2, 2"),
      x,
      thickness,
      angle);
  }


  /// A sheet whose lower side, lower end and motion by whole cells are on grid planes.
  template <int dim>
  std::string
  sheet_on_planes(const double thickness)
  {
    return fmt::format(
      plane_or_space<dim>(
        "set Lower corner = .25, .25\nset Upper corner = {}, .75\nset Cells = 1, 2",
        "set Lower corner = .25, .25, .25\nset Upper corner = {}, .75, .75\nset "
        "Cells = 1, 2, 2"),
      .25 + thickness);
  }


  template <int dim>
  void
  check_all(const std::vector<double> &thicknesses)
  {
    const auto slanting = stream<dim>({{1.3, .4, .3}}, .03);
    const auto by_cells = stream<dim>({{1, 0, 0}}, .125);
    for (const double cells : thicknesses)
      {
        check_translation(slanting, "box", sheet<dim>(cells / 8, .6, 23));
        check_translation(by_cells, "box", sheet_on_planes<dim>(cells / 8));
      }
    check_translation(
      slanting,
      "ball",
      plane_or_space<dim>("set Centre = .6, .5\nset Radius = .2\nset Refinements = 3",
                          "set Centre = .6, .5, .5\nset Radius = .2\nset Refinements = 2"));
  }
} // namespace


TEST_CASE("An obstacle that moves along with a stream does not disturb it", "[coupled][mpi]")
{
  SECTION("2D")
  {
    check_all<2>({1e-6, 1e-3, .1, .9, 1, 1.3, 2});
  }
  SECTION("3D")
  {
    check_all<3>({1e-6, .1, 1, 2});
  }
}


TEST_CASE("A sheet leaves with the stream through an opening", "[coupled][mpi]")
{
  check_translation(stream<2>({{1, 0, 0}}, .0625), "box", sheet<2>(1e-3, 1.4, 10));
  check_translation(stream<2>({{1, 0, 0}}, .0625), "box", sheet<2>(.1, 1.4, 0));
}
