// SPDX-License-Identifier: LGPL-2.1-or-later
#include <coupled/obstacle_run.h>

#include <random>

using namespace undine_tests;

namespace
{
  constexpr double fluid_density = 800, acceleration = 9.7;

  /// Expressions that turn by an angle in each coordinate plane, then shift.
  template <int dim>
  std::string
  turned_about(std::array<double, 3> angles, const dealii::Point<dim> &centre)
  {
    std::array<std::string, 3> axes{{"x", "y", "z"}};
    for (unsigned int plane = 0; plane < dim * (dim - 1) / 2; ++plane)
      {
        const unsigned int a = plane == 2 ? 1 : 0, b = plane == 0 ? 1 : 2;
        const double       c = std::cos(angles[plane]), s = std::sin(angles[plane]);
        const auto         old = axes;
        axes[a]                = fmt::format("({:.17g}*{} - {:.17g}*{})", c, old[a], s, old[b]);
        axes[b]                = fmt::format("({:.17g}*{} + {:.17g}*{})", s, old[a], c, old[b]);
      }
    std::string result;
    for (unsigned int d = 0; d < dim; ++d)
      result += fmt::format("{}{:.17g} + {}", d == 0 ? "" : "; ", centre[d], axes[d]);
    return result;
  }


  /// Boxes at all angles, from sheets to cubes, a ball, and one that stands in floor and wall.
  template <int dim>
  std::string
  things()
  {
    std::mt19937 engine(7);
    const auto   random = [&] { return engine() / 4294967296.; };
    std::string  text;
    int          number = 0;
    for (const double thickness : {1e-6, 1e-2, .1, .2})
      for (const double x : {.3, .75})
        {
          dealii::Point<dim> centre;
          for (unsigned int d = 0; d < dim; ++d)
            centre[d] = .5 + .04 * random();
          centre[0] = x;
          centre[1] = .25 + .45 * (number / 2);
          text += obstacle(
            fmt::format("thing {}", number++),
            "box",
            fmt::format("set Centre = {}\nset Size = {}\nset Cells = {}\nset Refinements = 0\nset "
                        "Map = {}",
                        plane_or_space<dim>("0, 0", "0, 0, 0"),
                        fmt::format(plane_or_space<dim>("{}, .25", "{}, .25, .25"), thickness),
                        plane_or_space<dim>("1, 3", "1, 3, 2"),
                        turned_about<dim>({{6 * random(), 6 * random(), 6 * random()}}, centre)));
        }
    text += obstacle("ball",
                     "ball",
                     "set Centre = " + plane_or_space<dim>(".5, 2", ".5, 2, .5") +
                       "\nset Radius = .15\nset Refinements = " + (dim == 2 ? "4" : "2"));
    return text;
  }


  /// Where walls and bodies are all around a fluid at rest, they carry its weight.
  template <int dim>
  void
  check_that_all_carry_the_fluid(const ObstacleRun<dim> &run, const dealii::Tensor<1, dim> &gravity)
  {
    auto one = run.state.fluid.pressure;
    for_each_unplaced_value(one, [](double &value) { value = 1; });
    const auto             weight = fluid_density * integral(*run.models.fluid, one) * gravity;
    dealii::Tensor<1, dim> carried;
    for (const char *wall : {"lid", "other sides"})
      carried += run.column_vector(std::string("Pressure force on ") + wall + ",");
    for (const auto &name : run.surface().body_names())
      carried += run.column_vector("pressure force " + name);
    CHECK((carried - weight).norm() <= 1e-12 * weight.norm());
  }


  template <int dim>
  void
  check_rest(const std::string &kind_of_top, const std::string &more_domain = "")
  {
    ObstacleRun<dim> run(
      section("Domain",
              plane_or_space<dim>("set Upper corner = 1, 2.3\nset Cells = 13, 31\n",
                                  "set Upper corner = 1, 2.3, 1\nset Cells = 10, 23, 9\n") +
                more_domain) +
        section("Fluid",
                fmt::format("set Density = {}\n", fluid_density) +
                  section("Boundaries", boundary("lid", "top", kind_of_top))),
      things<dim>() +
        obstacle("wedge",
                 "box",
                 plane_or_space<dim>(
                   "set Centre = 0, 2.3\nset Size = .4, .17\nset Rotation = 31",
                   "set Centre = 0, 2.3, .5\nset Size = .4, .17, .3\nset Rotation = 31, 20, 10")),
      section("gravity",
              "set Acceleration = " +
                fmt::format(plane_or_space<dim>("{}, {}", "{}, {}, 1"), .5, -acceleration)) +
        convection() + section("scalar transport", section("smoke", "set Initial value = y")),
      .01);
    const double scale = acceleration * run.models.fluid->grid().cell_width(0, 0);
    for (unsigned int n = 0; n < 20; ++n)
      {
        run.step();
        const double speed = largest_on_faces(
          run.state.fluid.velocity,
          [](const double value, const auto &, unsigned) { return std::abs(value); });
        REQUIRE(speed <= 1e-12 * std::sqrt(scale));
        REQUIRE(largest_in_cells(run.state.fluid.pressure, [](const double value, const auto &) {
                  return std::abs(value);
                }) <= 1e-12 * fluid_density * acceleration);
      }
    CHECK(run.column("Flagged cells") == 0);

    dealii::Tensor<1, dim> gravity;
    gravity[0]         = .5;
    gravity[1]         = -acceleration;
    gravity[dim - 1]   = dim == 3 ? 1 : gravity[dim - 1];
    const auto volumes = body_volumes(run.surface(), run.positions());
    for (unsigned int b = 0; b + 1 < volumes.size(); ++b)
      {
        const auto name = run.surface().body_names()[b];
        const auto error =
          run.column_vector("pressure force " + name) + fluid_density * volumes[b] * gravity;
        INFO(name << " of volume " << volumes[b]);
        // Of a sheet the forces on both sides cancel.
        CHECK(error.norm() <=
              1e-12 * fluid_density * acceleration * std::max(volumes[b], 2.3 * .05));
      }
    if (kind_of_top == "slip wall")
      check_that_all_carry_the_fluid(run, gravity);
  }
} // namespace


TEST_CASE("Fluid under gravity rests among walls and obstacles at all angles", "[coupled][mpi]")
{
  SECTION("2D, closed")
  {
    check_rest<2>("slip wall");
  }
  SECTION("2D, open")
  {
    check_rest<2>("outflow");
  }
  SECTION("2D, open, graded")
  {
    check_rest<2>("outflow",
                  "set Grading x = x + .1*sin(2*pi*x)\nset Grading y = x - .05*sin(2*pi*x)");
  }
  SECTION("3D")
  {
    check_rest<3>("slip wall");
  }
}
