// SPDX-License-Identifier: LGPL-2.1-or-later
#include <coupled/obstacles/uniform_stream.h>

using namespace undine_tests;

namespace
{
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
    const auto slanting = UniformStream<dim>({{1.3, .4, .3}}, .03).through();
    const auto by_cells = UniformStream<dim>({{1, 0, 0}}, .125).through();
    for (const auto &form : {convection(), flux_form()})
      {
        for (const double cells : thicknesses)
          {
            check_translation(slanting, "box", sheet<dim>(cells / 8, .6, 23), form);
            check_translation(by_cells, "box", sheet_on_planes<dim>(cells / 8), form);
          }
        for (const double cells : {thicknesses.front(), .08, 2.})
          check_translation(slanting.graded(), "box", sheet<dim>(cells / 8, .6, 23), form);
        check_translation(
          slanting,
          "ball",
          plane_or_space<dim>("set Centre = .6, .5\nset Radius = .2\nset Refinements = 3",
                              "set Centre = .6, .5, .5\nset Radius = .2\nset Refinements = 2"),
          form);
      }
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
  const auto stream = UniformStream<2>({{1, 0, 0}}, .0625).through();
  for (const auto &form : {convection(), flux_form()})
    {
      check_translation(stream, "box", sheet<2>(1e-3, 1.4, 10), form);
      check_translation(stream, "box", sheet<2>(.1, 1.4, 0), form);
    }
}
