// SPDX-License-Identifier: LGPL-2.1-or-later
#include <coupled/obstacles/uniform_stream.h>

using namespace undine_tests;

namespace
{
  /// A ball that goes from one periodic side to the other, in steps of one cell, and a thin sheet.
  template <int dim>
  void
  check_travels(const UniformStream<dim> &stream)
  {
    for (const auto &form : {convection(), flux_form()})
      {
        check_translation(
          stream,
          "ball",
          plane_or_space<dim>("set Centre = .24, .3\nset Radius = .2\nset Refinements = 3",
                              "set Centre = .24, .3, .3\nset Radius = .2\nset Refinements = 2"),
          form);
        check_translation(
          stream,
          "box",
          plane_or_space<dim>(
            "set Centre = .22, .5\nset Size = .001, .4\nset Rotation = 23\nset Cells = 1, 3",
            "set Centre = .22, .5, .5\nset Size = .001, .4, .4\nset Rotation = 10, 20, "
            "30\nset Cells = 1, 2, 2"),
          form);
      }
  }


  /// One that nearly meets its own image: less than half a cell is left on either side.
  template <int dim>
  void
  check_long_box(const std::array<double, 3> &velocity, const std::string &sides)
  {
    for (const auto &form : {convection(), flux_form()})
      check_translation(
        UniformStream<dim>(velocity, .1).around(sides),
        "box",
        plane_or_space<dim>("set Lower corner = .01, .3\nset Upper corner = 1.96, .7",
                            "set Lower corner = .01, .3, .02\nset Upper corner = 1.96, .7, .97"),
        form);
  }


  /// All values of a field, on every rank, the first direction running fastest.
  template <int dim>
  std::vector<double>
  gathered(const Field<dim> &field)
  {
    const IndexBox<dim> whole{{}, field.lattice().shape()};
    std::vector<double> values(whole.size(), 0.);
    for_each(field.owned(),
             [&](const GridIndex<dim> &index) { values[whole.position(index)] = field(index); });
    dealii::Utilities::MPI::sum(values, MPI_COMM_WORLD, values);
    return values;
  }


  /// The largest difference between a field and another one in which everything lies `cells`
  /// farther along x.
  template <int dim>
  double
  difference(const Field<dim> &field, const Field<dim> &shifted, const int cells)
  {
    const auto          values = gathered(shifted);
    const IndexBox<dim> whole{{}, field.lattice().shape()};
    double              result = 0;
    for_each(field.owned(), [&](const GridIndex<dim> &index) {
      const auto there = field.lattice().wrapped(moved(index, 0, cells));
      result           = std::max(result, std::abs(field(index) - values[whole.position(there)]));
    });
    return dealii::Utilities::MPI::max(result, MPI_COMM_WORLD);
  }


  /// A ball that swings in a stream full of smoke. Everything lies `cells` farther along x than in
  /// the middle of the domain; cells are 1/16 or 1/8 long.
  template <int dim>
  std::unique_ptr<ObstacleRun<dim>>
  swinging_ball(const int cells, const std::string &method)
  {
    const double shift = cells / (dim == 2 ? 16. : 8.);
    return std::make_unique<ObstacleRun<dim>>(
      section("Domain",
              plane_or_space<dim>("set Upper corner = 2, 1\nset Cells = 32, 16",
                                  "set Upper corner = 2, 1, 1\nset Cells = 16, 8, 8")) +
        section(
          "Fluid",
          "set Density = 1000\nset Initial velocity = " + plane_or_space<dim>("1; 0", "1; 0; .3") +
            "\n" + section("Pressure solver", "set Divergence tolerance = 1e-13") +
            section("Boundaries",
                    boundary("round",
                             plane_or_space<dim>("left, right", "left, right, back, front"),
                             "periodic"))),
      obstacle("thing",
               "ball",
               fmt::format(plane_or_space<dim>("set Centre = {}, .47\nset Radius = .26\n"
                                               "set Displacement = .1*sin(9*t); .1*sin(7*t)",
                                               "set Centre = {}, .47, .51\nset Radius = .26\nset "
                                               "Refinements = 2\nset Displacement = .1*sin(9*t); "
                                               ".1*sin(7*t); .1*sin(5*t)"),
                           1.02 + shift)),
      convection(method) +
        section(
          "scalar transport",
          "set Method = " + method + "\n" +
            section("smoke",
                    fmt::format("set Initial value = 1 + sin(pi*(x - {:.17g}))*cos(3*y)", shift))),
      .04);
  }


  /// In a periodic domain it makes no difference where everything lies.
  template <int dim>
  void
  check_shift(const int cells, const std::string &method)
  {
    INFO(cells << " cells, " << method);
    const auto middle = swinging_ball<dim>(0, method), shifted = swinging_ball<dim>(cells, method);
    double     impulse = 0; // the largest of the pressure
    for (unsigned int n = 0; n < 6; ++n)
      {
        middle->step();
        shifted->step();
        const auto &a = middle->state.fluid, &b = shifted->state.fluid;
        for (unsigned int axis = 0; axis < dim; ++axis)
          REQUIRE(difference(a.velocity[axis], b.velocity[axis], cells) <= 1e-11);
        REQUIRE(difference(a.scalars.at("smoke"), b.scalars.at("smoke"), cells) <= 1e-11);
        impulse =
          std::max(impulse, largest_in_cells(a.pressure, [](const double value, const auto &) {
                     return std::abs(value);
                   }));
        REQUIRE(difference(a.pressure, b.pressure, cells) <= 1e-10 * impulse);
        REQUIRE(shifted->column("Fluid divergence") <= 1e-13);
        REQUIRE((middle->column_vector("pressure force thing") -
                 shifted->column_vector("pressure force thing"))
                  .norm() <= 1e-10 * impulse);
      }
    CHECK(impulse > 100);
  }


  /// The force of friction on a box past which fluid flows along x, `cells` of the width 1/8 from
  /// where it has a quarter of a cell to the periodic side.
  template <int dim>
  dealii::Tensor<1, dim>
  friction_on_box(const int cells)
  {
    const auto corner = [&](const double x, const std::string &others) {
      return fmt::format("{:.17g}{}", x - cells / 8., others);
    };
    ObstacleRun<dim> run(
      section("Domain",
              plane_or_space<dim>("set Upper corner = 2, 1\nset Cells = 16, 8",
                                  "set Upper corner = 2, 1, 1\nset Cells = 16, 8, 8")) +
        section(
          "Fluid",
          "set Density = 1\nset Initial velocity = " + plane_or_space<dim>("1; 0", "1; 0; 0") +
            "\n" + section("Pressure solver", "set Divergence tolerance = 1e-13") +
            section("Boundaries", boundary("round", "left, right", "periodic"))),
      obstacle("thing",
               "box",
               "set Lower corner = " + corner(.91, plane_or_space<dim>(", .33", ", .33, .29")) +
                 "\nset Upper corner = " +
                 corner(2 - .25 / 8, plane_or_space<dim>(", .68", ", .68, .73"))),
      viscosity(.1),
      .04);
    for (unsigned int n = 0; n < 4; ++n)
      run.step();
    return run.column_vector("viscous force thing");
  }


  template <int dim>
  void
  check_friction_beside_a_side()
  {
    const auto beside = friction_on_box<dim>(0);
    for (const int cells : {1, 4, 7})
      {
        const auto middle = friction_on_box<dim>(cells);
        INFO(cells << " cells off: " << middle << ", beside the side: " << beside);
        CHECK((middle - beside).norm() <= 1e-8 * beside.norm());
      }
  }
} // namespace


TEST_CASE("An obstacle that moves along with a stream around a periodic domain does not disturb it",
          "[coupled][mpi]")
{
  SECTION("2D")
  {
    const UniformStream<2> along({{1, 0, 0}}, .125), slanting({{1, .15, 0}}, .125);
    check_travels(along.around("left, right"));
    check_travels(along.around("left, right").graded());
    check_travels(slanting.around("left, right, bottom, top"));
    check_travels(slanting.around("left, right, bottom, top").graded());
    check_long_box<2>({{.02, 0, 0}}, "left, right");
  }
  SECTION("3D")
  {
    check_travels(UniformStream<3>({{1, 0, 0}}, .125).around("left, right"));
    check_travels(
      UniformStream<3>({{1, 0, .12}}, .125).around("left, right, back, front").graded());
    check_long_box<3>({{.02, 0, -.01}}, "left, right, back, front");
  }
}


TEST_CASE("It makes no difference where an obstacle swings in a periodic domain", "[coupled][mpi]")
{
  SECTION("2D")
  {
    // So that less than one cell, or one to three, are left between it and a periodic side.
    for (const int cells : {-12, -11, -10, 7, 8, 9})
      check_shift<2>(cells, "cubic");
    check_shift<2>(-12, "MacCormack");
    check_shift<2>(9, "semi-Lagrangian");
  }
  SECTION("3D")
  {
    check_shift<3>(-5, "cubic");
    check_shift<3>(4, "MacCormack");
  }
}


TEST_CASE("Friction on a body next to a periodic side is that anywhere else", "[coupled][mpi]")
{
  SECTION("2D")
  {
    check_friction_beside_a_side<2>();
  }
  SECTION("3D")
  {
    check_friction_beside_a_side<3>();
  }
}
