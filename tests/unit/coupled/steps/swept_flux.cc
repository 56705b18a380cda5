// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/coupled/immersed/surface_flux.h>
#include <undine/solid/assembly/mass_matrix.h>
#include <undine/surface/simplex.h>

#include <coupled/coupled_run.h>

using namespace undine_tests;

namespace
{
  /// A ball and a box with quadratic sides under gravity, beside an obstacle, in water.
  template <int dim>
  CoupledRun<dim>
  ball_and_box()
  {
    constexpr const char *material =
      "\nset Density = 1000\nset Young's modulus = 1e5\nset Poisson's ratio = .3";
    return CoupledRun<dim>(
      steps_of(.1) + section("Domain", "set Cells = " + plane_or_space<dim>("8, 8", "8, 8, 8")) +
      section("Fluid",
              "set Density = 1000\n" +
                section("Boundaries", boundary("surface", "top", "pressure", "set Pressure = 0"))) +
      section("Bodies",
              body("ball",
                   "set Shape = ball\nset Radius = .15\nset Centre = " +
                     plane_or_space<dim>(".3, .3", ".3, .3, .3") + material) +
                body("box",
                     "set Cells = " + plane_or_space<dim>("2, 1", "2, 1, 1") +
                       "\nset Lower corner = " + plane_or_space<dim>(".5, .6", ".5, .6, .4") +
                       "\nset Upper corner = " + plane_or_space<dim>(".8, .8", ".8, .8, .7") +
                       material)) +
      section("Obstacles",
              section("block",
                      "set Lower corner = " + plane_or_space<dim>(".6, .1", ".6, .1, .3") +
                        "\nset Upper corner = " + plane_or_space<dim>(".9, .3", ".9, .3, .6"))) +
      section(
        "Effects",
        section("gravity", "set Acceleration = " + plane_or_space<dim>("1, -9", "1, -9, 2"))));
  }


  constexpr double pressure_of_air = 2e4; // [Pa]

  /// A slab from side to side, water above and air below.
  template <int dim>
  CoupledRun<dim>
  slab_above_air()
  {
    return CoupledRun<dim>(
      steps_of(.1) + section("Domain", "set Cells = " + plane_or_space<dim>("8, 8", "6, 6, 6")) +
      section("Fluid",
              "set Density = 1000\n" +
                section("Boundaries", boundary("surface", "top", "pressure", "set Pressure = 0")) +
                section("Void regions",
                        section("air",
                                "set Seed = " + plane_or_space<dim>(".5, .2", ".5, .2, .5") +
                                  fmt::format("\nset Pressure = {}", pressure_of_air)))) +
      section("Bodies",
              body("slab",
                   "set Cells = " + plane_or_space<dim>("4, 1", "4, 1, 4") +
                     "\nset Lower corner = " + plane_or_space<dim>("0, .45", "0, .45, 0") +
                     "\nset Upper corner = " + plane_or_space<dim>("1, .55", "1, .55, 1") +
                     "\nset Density = 1000\nset Young's modulus = 1e5\nset Poisson's ratio = "
                     ".3")));
  }


  constexpr double pressure_above = 1e5; // [Pa]

  /// A bar that sticks out of the water through an opening under pressure.
  template <int dim>
  CoupledRun<dim>
  bar_through_opening()
  {
    return CoupledRun<dim>(
      steps_of(.1) + section("Domain", "set Cells = " + plane_or_space<dim>("8, 8", "6, 6, 6")) +
      section("Fluid",
              "set Density = 1000\n" +
                section("Boundaries",
                        boundary("surface",
                                 "top",
                                 "pressure",
                                 fmt::format("set Pressure = {}", pressure_above)))) +
      section("Bodies",
              body("bar",
                   "set Cells = " + plane_or_space<dim>("1, 4", "1, 4, 1") +
                     "\nset Lower corner = " + plane_or_space<dim>(".4, .7", ".4, .7, .4") +
                     "\nset Upper corner = " + plane_or_space<dim>(".5, 1.3", ".5, 1.3, .6") +
                     "\nset Density = 1000\nset Young's modulus = 1e5\nset Poisson's ratio = "
                     ".3")));
  }


  /// The surface flux of a step in which bodies move from rest.
  template <int dim>
  struct SweptStep
  {
    using Vector = typename SolidModel<dim>::Vector;

    explicit SweptStep(CoupledRun<dim> (*scene)())
      : run(scene())
      , mass(mass_matrix(*run.models.solid))
      , environment(run.models.environment())
      , equations(*run.models.solid, mass, run.state.solid, environment, 0, dt, timing)
      , geometry(run.models)
      , numbers(run.models.fluid->grid(), cut().bodies().topology)
      , flux(make_surface_flux("swept",
                               run.models,
                               geometry,
                               numbers,
                               equations,
                               BodiesInStage<dim>(run.models, run.state, single_stage(dt), 0)))
    {
    }

    const FluidGeometry<dim> &
    cut()
    {
      const auto places = run.models.surface->positions(run.state.solid, 0);
      geometry.place(places, places, std::vector<dealii::Tensor<1, dim>>(places.size()));
      return geometry;
    }

    /// Velocities that are neither rigid nor slow [m/s].
    Vector
    scattered(const double phase) const
    {
      const auto &model  = *run.models.solid;
      auto        result = model.vector();
      for (const auto dof : model.locally_owned())
        {
          const auto &x = model.rest_position(dof);
          result(dof)   = .5 * std::sin(phase + 7 * x[0] + 5 * x[dim - 1] + 2 * model.axis(dof));
        }
      result.compress(dealii::VectorOperation::insert);
      return result;
    }

    Field<dim>
    scattered_pressure() const
    {
      const auto &grid = run.models.fluid->grid();
      Field<dim>  result(grid.cells(), geometry.bodies().topology);
      for_each(result.owned(), [&](const GridIndex<dim> &cell) {
        double sum = 1;
        for (unsigned int d = 0; d < dim; ++d)
          sum = std::sin(12.9898 * sum + 78.233 * (cell[d] + 1) * (d + 1));
        for_each_place(result.divided(), cell, [&](const FacePlace<dim> &place) {
          value_at(result, cell, place.part) = 1e4 * sum;
        });
      });
      return result;
    }

    /// On the bodies if they end with this velocity [N].
    Vector
    forces(const Vector &velocity, const Field<dim> &pressure)
    {
      flux->move(velocity);
      auto result = flux->on_bodies(flux->nodal_forces(pressure));
      result.add(1., flux->on_bodies(flux->change_at_rest()));
      return result;
    }

    static constexpr double                dt = .1;
    CoupledRun<dim>                        run;
    const typename SolidModel<dim>::Matrix mass;
    const SolidEnvironment<dim>            environment;
    TimingTree                             timing;
    SolidEquations<dim>                    equations;
    FluidGeometry<dim>                     geometry;
    const PressureNumbers<dim>             numbers;
    std::unique_ptr<SurfaceFlux<dim>>      flux;
  };


  template <int dim>
  void
  check_stiffness(CoupledRun<dim> (*scene)())
  {
    INFO(dim << "D");
    SweptStep<dim> step(scene);
    const auto     pressure = step.scattered_pressure();
    const auto     here = step.scattered(.3), change = step.scattered(1.1);
    const auto     at = [&](const double part) {
      auto velocity = here;
      velocity.add(part, change);
      return step.forces(velocity, pressure);
    };
    // Forces are quadratic functions of velocities: this difference is the derivative.
    auto difference = at(.5);
    difference.add(-1., at(-.5));

    step.flux->move(here);
    auto stiffness = step.run.models.solid->matrix();
    step.flux->subtract_stiffness(stiffness, pressure);
    auto product = step.run.models.solid->vector();
    stiffness.vmult(product, change);
    CHECK(product.l2_norm() > 10);
    difference.add(1., product);
    CHECK(difference.l2_norm() <= 1e-10 * product.l2_norm());
  }


  /// Of a uniform pressure on a bar that moves in any way: none.
  template <int dim>
  void
  check_resultant()
  {
    INFO(dim << "D");
    SweptStep<dim> step(bar_through_opening<dim>);
    step.flux->move(step.scattered(.3));
    Field<dim> pressure(step.run.models.fluid->grid().cells(), step.geometry.bodies().topology);
    for_each_value(pressure,
                   [&](double &value, const auto &, const auto &) { value = pressure_above; });
    const auto             inside  = step.flux->nodal_forces(pressure);
    const auto             change  = step.flux->change_at_rest();
    const auto             outside = step.geometry.other_forces({}, step.dt);
    dealii::Tensor<1, dim> resultant, of_inside;
    for (std::size_t node = 0; node < inside.size(); ++node)
      {
        of_inside += inside[node];
        resultant += inside[node] + change[node] + outside[node];
      }
    CHECK(of_inside.norm() > 1e-3 * pressure_above);
    CHECK(resultant.norm() <= 1e-10 * pressure_above);
  }


  /// The volume below the facets of the lower side [m^dim], up to what lies below its rim.
  template <int dim>
  double
  volume_below(const CoupledRun<dim>                 &run,
               const std::vector<dealii::Point<dim>> &rest,
               const std::vector<dealii::Point<dim>> &positions)
  {
    double volume = 0;
    for (const auto &facet : run.models.surface->surface().facets())
      if (std::all_of(
            facet.begin(), facet.end(), [&](const auto node) { return rest[node][1] < .46; }))
        {
          std::array<dealii::Point<dim>, dim> corners;
          for (unsigned int k = 0; k < dim; ++k)
            corners[k] = positions[facet[k]];
          volume -= dealii::Tensor<1, dim>(corners[0]) * area_vector(corners) / dim;
        }
    return volume;
  }


  /// Of the air, where the slab moves in its middle, along its own plane, too.
  template <int dim>
  void
  check_work_of_air()
  {
    INFO(dim << "D");
    SweptStep<dim> step(slab_above_air<dim>);
    const auto    &run      = step.run;
    const auto    &model    = *run.models.solid;
    auto           velocity = step.scattered(.3);
    for (const auto dof : model.locally_owned())
      for (unsigned int d = 0; d < dim; ++d)
        if (const auto &x = model.rest_position(dof); d != 1)
          velocity(dof) = velocity(dof) * std::sin(dealii::numbers::PI * x[d]);
    velocity.compress(dealii::VectorOperation::insert);
    step.flux->move(velocity);
    auto forces = step.flux->change_at_rest();
    REQUIRE(!forces.empty());
    const auto at_begin = step.geometry.other_forces({}, step.dt);
    auto       way      = step.equations.increment(velocity);
    const auto ways =
      run.models.surface->with_bodies(way, std::vector<dealii::Tensor<1, dim>>(forces.size()));
    const auto rest  = run.models.surface->positions(run.state.solid, 0);
    auto       after = rest;
    double     work = 0, by_begin = 0;
    for (std::size_t node = 0; node < forces.size(); ++node)
      {
        work += (at_begin[node] + forces[node]) * ways[node];
        by_begin += at_begin[node] * ways[node];
        after[node] += ways[node];
      }
    const double expected =
      pressure_of_air * (volume_below(run, rest, after) - volume_below(run, rest, rest));
    CHECK(work == Approx(expected).epsilon(1e-11));
    CHECK(std::abs(by_begin - expected) > 1e-2 * std::abs(expected)); // else it shows nothing
  }
} // namespace


TEST_CASE("The tangent knows how surfaces turn in a step by swept flux", "[coupled][mpi]")
{
  check_stiffness<2>(ball_and_box<2>);
  check_stiffness<3>(ball_and_box<3>);
  check_stiffness<2>(bar_through_opening<2>);
  check_stiffness<3>(bar_through_opening<3>);
}


TEST_CASE("A uniform pressure inside and outside of openings has no resultant by swept flux",
          "[coupled][mpi]")
{
  check_resultant<2>();
  check_resultant<3>();
}


TEST_CASE("The pressure of void regions does its work on the volume that surfaces sweep",
          "[coupled][mpi]")
{
  check_work_of_air<2>();
  check_work_of_air<3>();
}
