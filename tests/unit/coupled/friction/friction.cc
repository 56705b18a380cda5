// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/coupled/step/fluid_side.h>
#include <undine/fluid/boundary/boundary_quantities.h>
#include <undine/fluid/grid/field_algebra.h>
#include <undine/operators/body_forces.h>

#include <coupled/coupled_run.h>
#include <coupled/friction/viscous_flows.h>

using namespace undine_tests;

namespace
{
  /// A closed box with a fixed and a moving body, in which the fluid swirls.
  template <int dim>
  std::string
  swirl_among_bodies()
  {
    const std::string swirl =
      plane_or_space<dim>("sin(6*y)+x; cos(5*x)*y", "sin(6*y)+x; cos(5*x)*z; x*y");
    return section("Domain", plane_or_space<dim>("set Cells = 17, 13", "set Cells = 9, 8, 7")) +
           section("Fluid",
                   "set Density = 700\nset Initial velocity = " + swirl + "\n" +
                     section("Boundaries", boundary("walls", every_side<dim>(), "no-slip wall")));
  }


  template <int dim>
  void
  check_momentum()
  {
    const std::string bodies =
      obstacle("disc",
               "ball",
               plane_or_space<dim>("set Centre = .31, .4", "set Centre = .31, .4, .52") +
                 "\nset Radius = .17") +
      obstacle("bar",
               "box",
               plane_or_space<dim>("set Centre = .7, .6\nset Size = .05, .4\nset Rotation = 20\n"
                                   "set Displacement = .3*sin(t); .1*t",
                                   "set Centre = .7, .6, .5\nset Size = .05, .4, .3\nset Rotation "
                                   "= 20, 10, 40\nset Displacement = .3*sin(t); .1*t; 0"));
    const Options options(read_scene_text(swirl_among_bodies<dim>() + section("Obstacles", bodies) +
                                          section("Effects", viscosity(30))));
    const auto    models = make_models<dim>(options);
    Budget<dim>   budget(models, KeepBudget::yes);
    TimingTree    timing;
    FluidAlone<dim> scheme(models, budget, timing);
    State<dim>      state;
    Report          report;
    const double    dt = .01;
    scheme.initialize(state, dt, report);
    FluidSide<dim> side(models, budget, timing);
    const Stage    stage = single_stage(dt);
    budget.begin_stage(stage);
    const auto fluid = side.predict(state, stage, report);
    REQUIRE(fluid->friction);
    dealii::Tensor<1, dim> on_nodes, on_sides;
    for (const auto &force : fluid->friction->on_nodes)
      on_nodes += force;
    for (const auto &force : fluid->friction->on_boundaries)
      on_sides += force;
    budget.add(PressureBalance<dim>(), state.fluid.velocity, state.fluid.velocity);
    budget.end_stage();
    const auto   columns   = budget.columns();
    unsigned int n_columns = 0;
    for (unsigned int axis = 0; axis < dim; ++axis)
      for (const auto &column : columns)
        if (column.name == std::string("momentum by diffusion ") + "xyz"[axis])
          {
            ++n_columns;
            INFO("axis " << axis << " " << column.value << " " << on_nodes << " " << on_sides);
            CHECK(std::abs(on_nodes[axis]) > 1e-3);
            CHECK(std::abs(column.value + dt * (on_nodes[axis] + on_sides[axis])) <=
                  1e-9 * dt * (on_nodes.norm() + on_sides.norm()));
          }
    CHECK(n_columns == dim);
  }


  /// The flow in a box after friction with a bar that moves through it along x.
  Velocity<2>
  stirred(const double value)
  {
    ObstacleRun<2> run(
      section("Domain", "set Cells = 20, 20") +
        section("Fluid",
                "set Density = 1\n" +
                  section("Boundaries",
                          boundary("top", "top", "outflow") +
                            boundary("walls", "left, right, bottom", "no-slip wall"))),
      obstacle("bar",
               "box",
               "set Centre = .51, .43\nset Size = .05, .3\nset Rotation = "
               "20\nset Displacement = t; 0"),
      viscosity(value),
      .01);
    FluidSide<2> side(run.models, run.budget, run.timing);
    run.state.fluid.velocity =
      run.models.fluid->initial_state(run.state.fluid.pressure.topology()).velocity;
    run.state.fluid.pressure =
      Field<2>(run.models.fluid->grid().cells(), run.state.fluid.pressure.topology());
    Report report;
    side.predict(run.state, single_stage(.01), report);
    return run.state.fluid.velocity;
  }


  double
  order(const double coarse, const double fine)
  {
    return std::log2(coarse / fine);
  }
} // namespace


TEST_CASE("Friction leaves a linear flow alone that bodies move along with", "[friction][mpi]")
{
  // A shear flow along s, v = s (n.x), past a body that is sheared alike.
  for (const double angle : {0., .3, .9, 2.})
    for (const char *shape :
         {"ball\nset Centre = .47, .52\nset Radius = .23",
          "box\nset Centre = .52, .49\nset Size = .4, .03\nset Rotation = 33\nset Cells = 7, 1",
          "box\nset Lower corner = .25, .375\nset Upper corner = .5, .625"})
      {
        INFO(shape << ", " << angle);
        const double      c = std::cos(angle), s = std::sin(angle);
        const auto        shear  = "(" + number(-s) + "*x+" + number(c) + "*y)";
        const auto        linear = number(c) + "*" + shear + ";" + number(s) + "*" + shear;
        const auto        moving = "t*" + number(c) + "*" + shear + ";t*" + number(s) + "*" + shear;
        const std::string text   = shape;
        ObstacleRun<2>    run(
          given_on_all_sides<2>(16, 3, linear),
          section("body", "set Shape = " + text + "\nset Displacement = " + moving),
          viscosity(10),
          .01);
        run.step();
        const double error = largest_on_faces(
          run.state.fluid.velocity, [&](const double v, const auto &x, const int i) {
            return std::abs(v - (i == 0 ? c : s) * (-s * x[0] + c * x[1]));
          });
        CHECK(error <= 1e-9);
      }
}


TEST_CASE("A creeping flow does not lift a plate, wherever planes lie beside its ends",
          "[friction]")
{
  // Forwards and backwards it is the same flow: there is no lift. One velocity for what flows past
  // an edge and what is held back in front of the wall would lift it by .15 N/m.
  constexpr double h = .025;
  for (const double beyond_end : {.04, .96})
    for (const double beside : {.1, .25, .5}) // planes from end and side, in cells
      {
        const auto lower = [&](const double place, const double share) {
          const double cells = place / h + share;
          return h * (cells - std::round(cells));
        };
        const double  x = lower(.7, beyond_end), y = lower(.26, -beside);
        CoupledRun<2> run(
          steps_of(.1) +
          section("Domain",
                  "set Lower corner = " + number(x) + "," + number(y) + "\nset Upper corner = " +
                    number(x + 1.2) + "," + number(y + .4) + "\nset Cells = 48, 16\n") +
          section("Fluid",
                  "set Density = 1\n" +
                    section("Boundaries",
                            boundary("inlet",
                                     "left",
                                     "inflow",
                                     "set Velocity = 25 * (y - " + number(y) + ") * (" +
                                       number(y + .4) + " - y); 0") +
                              boundary("outlet", "right", "outflow") +
                              boundary("walls", "bottom, top", "no-slip wall"))) +
          section("Obstacles",
                  section("plate",
                          "set Shape = box\nset Lower corner = .4, .21\nset Upper corner = .7, "
                          ".26\nset Cells = 6, 1")) +
          section("Effects", viscosity(1)));
        for (unsigned int n = 0; n < 15; ++n)
          run.step();
        INFO(beyond_end << ", " << beside);
        CHECK(std::abs(run.column("pressure force plate y") +
                       run.column("viscous force plate y")) <= .05);
        CHECK(run.column("pressure force plate x") > 5);
      }
}


TEST_CASE("The flow around a turning disc converges with second order", "[friction]")
{
  double coarse = 0, fine = 0, largest = 0;
  for (const double shift : {0., .013, .027})
    {
      const auto on_coarse = TurningDisc(20, shift).errors(),
                 on_fine   = TurningDisc(40, shift).errors();
      UNSCOPED_INFO(on_coarse.first << " " << on_fine.first << ", " << on_coarse.second << " "
                                    << on_fine.second);
      coarse += on_coarse.second;
      fine += on_fine.second;
      largest = std::max(largest, on_fine.first);
    }
  CHECK(order(coarse, fine) >= 1.6);
  CHECK(largest <= .02);
}


TEST_CASE("What friction takes from the fluid it gives to surfaces and sides", "[friction][mpi]")
{
  SECTION("2D")
  {
    check_momentum<2>();
  }
  SECTION("3D")
  {
    check_momentum<3>();
  }
}


TEST_CASE("Fluid between tilted plates flows as in a parabola", "[friction]")
{
  const auto coarse = TiltedChannel(24).errors(), fine = TiltedChannel(48).errors();
  UNSCOPED_INFO(coarse.velocity << " " << fine.velocity << ", " << coarse.force << " "
                                << fine.force);
  CHECK(order(coarse.velocity, fine.velocity) >= 1.3);
  CHECK(order(coarse.force, fine.force) >= 1.3);
  CHECK(fine.velocity <= .002);
  CHECK(fine.force <= .006);
}


TEST_CASE("Friction is bounded at any viscosity", "[friction]")
{
  // The fluid was at rest.
  const auto fastest = [](const double viscosity) {
    return largest_on_faces(stirred(viscosity),
                            [](const double v, const auto &, const int) { return std::abs(v); });
  };
  CHECK(fastest(1e-14) <= 1e-9);
  // What sticks to the bar is as fast, nothing is faster.
  CHECK(fastest(1e-1) >= .9);
  CHECK(fastest(1e-1) <= 1.001);
  CHECK(fastest(1e6) >= .9);
  CHECK(fastest(1e6) <= 1.001);
}


TEST_CASE("A wall feels no friction where a body covers it", "[friction]")
{
  ObstacleRun<2> run(
    FluidText{"8, 8", boundary("lid", "top", "moving wall", "set Velocity = 3; 0")},
    section("roof", "set Lower corner = -.1, .75\nset Upper corner = 1.1, 1.1"),
    viscosity(2.),
    .1);
  run.step();
  CHECK(run.column("Viscous force on lid, x") == 0);
}


TEST_CASE("A wall feels the friction of the fluid between it and a body, wherever that ends",
          "[friction]")
{
  for (const double floor : {.875, .9, .9375, .95})
    {
      INFO(floor);
      ObstacleRun<2> run(
        FluidText{"8, 8", boundary("lid", "top", "moving wall", "set Velocity = 3; 0")},
        section("floor",
                fmt::format("set Lower corner = -.1, -.1\nset Upper corner = 1.1, "
                            "{}",
                            floor)),
        viscosity(2.),
        .1);
      const auto &model = *run.models.fluid;
      auto       &fluid = run.state.fluid;
      for_each_value(fluid.velocity[0], [&](double &value, const auto &place, const auto &) {
        value = 3 * (place[1] - floor) / (1 - floor);
      });
      set_means(fluid.velocity, model.grid());
      const auto forces = viscous_forces(model.boundaries(), fluid, 2., 0.);
      CHECK(forces[0][0] == Approx(-6 / (1 - floor)).epsilon(1e-9));
    }
}
