// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/boundary/boundary_condition.h>
#include <undine/fluid/grid/field_algebra.h>
#include <undine/fluid/model/fluid_quantities.h>
#include <undine/fluid/pressure/divergence.h>
#include <undine/fluid/pressure/pressure_gradient.h>
#include <undine/fluid/pressure/pressure_matrix.h>
#include <undine/fluid/pressure/projection.h>

#include <catch2/catch.hpp>
#include <fluid/fluid_scene.h>

using namespace undine_tests;

namespace
{
  template <int dim>
  std::string
  cells()
  {
    return dim == 2 ? "12, 9" : "7, 6, 5";
  }


  /// Walls, a given pressure, an outflow and, in space, a periodic direction on a graded grid.
  template <int dim>
  FluidText
  open_box()
  {
    return {cells<dim>(),
            boundary("wall", "left", "no-slip wall") +
              boundary("reservoir", "bottom", "pressure", "set Pressure = 7 + x") +
              boundary("out", "right", "outflow") +
              (dim == 3 ? boundary("around", "back, front", "periodic") : ""),
            "",
            "set Grading x = x^1.3\nset Grading y = (x+x^2)/2\n",
            3.};
  }


  template <int dim>
  FluidText
  closed_box()
  {
    return {cells<dim>(), "", "", "set Grading x = x^1.3\n", 3.};
  }


  template <int dim>
  double
  pressure_power(const Field<dim> &pressure, const std::vector<double> &divergence)
  {
    std::size_t k = 0;
    return sum_over(pressure.lattice(),
                    [&](const GridIndex<dim> &cell) { return pressure(cell) * divergence[k++]; });
  }
} // namespace


TEMPLATE_TEST_CASE_SIG("pressure gradient and divergence are adjoint: p.D v = v.D^T p",
                       "[projection][mpi]",
                       ((int dim), dim),
                       2,
                       3)
{
  for (const auto &text : {open_box<dim>(), closed_box<dim>()})
    {
      const auto model = make_model<dim>(text);
      auto       state = model.initial_state();
      fill_scattered(state.velocity);
      fill_scattered(state.pressure, 9);
      set_boundary_velocity(state.velocity, model.boundaries(), 0);
      exchange(state.velocity);
      state.pressure.exchange(1);
      auto openings = open_faces<dim>(model, state.velocity, nullptr, 0.);
      for (auto &open : openings)
        open.pressure = 0;
      const auto   gradient = pressure_acceleration(model, state.pressure, openings);
      const double work     = inner_product(model, state.velocity, gradient);
      CHECK(std::abs(work) > 1e-3);
      CHECK(pressure_power(state.pressure, divergence(model, state.velocity).owned_values()) ==
            Approx(work).epsilon(1e-12));
    }
}


TEMPLATE_TEST_CASE_SIG(
  "the assembled matrix is D (rho V)^-1 D^T", "[projection][mpi]", ((int dim), dim), 2, 3)
{
  for (const auto &text : {open_box<dim>(), closed_box<dim>()})
    {
      const auto                             model = make_model<dim>(text);
      dealii::TrilinosWrappers::SparseMatrix matrix;
      const PressureNumbers<dim>             pressures(model.grid(), nullptr);
      build_pressure_matrix(
        matrix, model, pressures, ClosedRegions<dim>(model, pressures).pinned());
      auto state = model.initial_state();
      fill_scattered(state.pressure, 9);
      // Row 0 of a closed box is altered, unless p_0 = 0.
      if (state.pressure.owned().contains({}))
        state.pressure(GridIndex<dim>{}) = 0;
      const auto                            numbers = model.grid().cells()->owned_numbers();
      dealii::TrilinosWrappers::MPI::Vector p(numbers, MPI_COMM_WORLD), product(p);
      const auto                            values = state.pressure.owned_values();
      std::copy(values.begin(), values.end(), p.begin());
      matrix.vmult(product, p);

      state.pressure.exchange(1);
      auto openings = open_faces<dim>(model, state.velocity, nullptr, 0.);
      for (auto &open : openings)
        open.pressure = 0;
      auto gradient = pressure_acceleration(model, state.pressure, openings);
      exchange(gradient);
      const auto expected = divergence(model, gradient).owned_values();
      for (std::size_t k = 0; k < expected.size(); ++k)
        REQUIRE(product.begin()[k] == Approx(expected[k]).margin(1e-12));
      CHECK(product.l2_norm() > 0.1);
    }
}


TEMPLATE_TEST_CASE_SIG(
  "after a projection no cell gains or loses volume", "[projection][mpi]", ((int dim), dim), 2, 3)
{
  for (const auto &text : {open_box<dim>(), closed_box<dim>()})
    for (const double dt : {1e-5, 0.1, 10.})
      {
        const auto      model = make_model<dim>(text);
        Projection<dim> projection(model);
        auto            state = model.initial_state();
        fill_scattered(state.velocity);
        const auto   report = projection.project(state, 0, dt);
        const double speed  = largest_speed(model, state.velocity);
        CHECK(speed > 0.1);
        CHECK(largest_divergence(model, state.velocity) <=
              1e-10 * largest_components(model, state.velocity).norm());
        CHECK(report.divergence <= 1e-10);

        // Twice is once: the pressure of the second projection only balances the openings.
        auto again = state;
        for_each(again.pressure.owned(),
                 [&](const GridIndex<dim> &cell) { again.pressure(cell) = 0; });
        if (!model.boundaries().has_opening())
          {
            projection.project(again, 0, dt);
            for (unsigned int axis = 0; axis < dim; ++axis)
              CHECK(largest_over(*model.grid().faces(axis), [&](const GridIndex<dim> &face) {
                      return std::abs(again.velocity[axis](face) - state.velocity[axis](face));
                    }) < 1e-9);
          }
      }
}


TEST_CASE("a projection removes energy and is the nearest divergence-free field", "[projection]")
{
  const auto    model = make_model<3>(closed_box<3>());
  Projection<3> projection(model);
  auto          state = model.initial_state();
  fill_scattered(state.velocity);
  set_boundary_velocity(state.velocity, model.boundaries(), 0);
  const auto before = state.velocity;
  projection.project(state, 0, 1);
  auto removed = before;
  add(removed, -1., state.velocity);
  CHECK(std::abs(inner_product(model, removed, state.velocity)) < 1e-9);
  CHECK(kinetic_energy(model, removed) + kinetic_energy(model, state.velocity) ==
        Approx(kinetic_energy(model, before)));
}


TEST_CASE("pressure drives the same flow whatever the step", "[projection][mpi]")
{
  // A frictionless channel with a pressure difference: dv/dt = dp / (rho L), p linear.
  const auto model =
    make_model<2>(FluidText{"8, 4",
                            boundary("high", "left", "pressure", "set Pressure = 10") +
                              boundary("low", "right", "pressure", "set Pressure = 4"),
                            "",
                            "set Upper corner = 2, 1\nset Grading x = x^1.2",
                            5.});
  Projection<2> projection(model);
  auto          state = model.initial_state();
  double        time  = 0;
  for (const double dt : {0.1, 0.4, 0.05})
    projection.project(state, time += dt, dt);
  CHECK(largest_over(*model.grid().faces(0), [&](const GridIndex<2> &face) {
          return std::abs(state.velocity[0](face) - time * 6 / (5. * 2));
        }) < 1e-10);
  CHECK(largest_over(*model.grid().cells(), [&](const GridIndex<2> &cell) {
          return std::abs(state.pressure(cell) - 10 + 3 * model.grid().cells()->point(cell)[0]);
        }) < 1e-8);
}


TEST_CASE("a closed box with a net inflow is refused by name", "[projection][mpi]")
{
  const auto in    = boundary("nozzle", "left", "inflow", "set Velocity = 2; 0");
  const auto sink  = boundary("sink", "right", "inflow", "set Velocity = 2; 0");
  const auto model = make_model<2>(FluidText{"6, 6", in});
  auto       state = model.initial_state();
  const auto why   = message_of([&] { Projection<2>(model).project(state, 0, 0.1); });
  CHECK_THAT(why,
             Catch::Matchers::Contains("no outlet") && Catch::Matchers::Contains("'nozzle' -2"));

  const auto balanced = make_model<2>(FluidText{"6, 6", in + sink});
  state               = balanced.initial_state();
  Projection<2>(balanced).project(state, 0, 0.1);
  CHECK(largest_over(*balanced.grid().faces(0), [&](const GridIndex<2> &face) {
          return std::abs(state.velocity[0](face) - 2);
        }) < 1e-9);
}


TEST_CASE("failures of the pressure solver say what to try", "[projection]")
{
  const auto model = make_model<2>(FluidText{
    "100, 100", "", "", "", 1., section("Pressure solver", "set Maximum iterations = 1")});
  auto       state = model.initial_state();
  fill_scattered(state.velocity);
  const auto why = message_of([&] { Projection<2>(model).project(state, 0, 0.1); });
  CHECK_THAT(why, Catch::Matchers::Contains("Maximum iterations"));

  state.velocity[0](GridIndex<2>{{3, 3}}) = std::nan("");
  CHECK_THAT(message_of([&] { Projection<2>(model).project(state, 0, 0.1); }),
             Catch::Matchers::Contains("not a finite number"));
}


TEST_CASE("projected fields do not depend on the number of ranks", "[projection][mpi]")
{
  const auto          text  = open_box<3>();
  const auto          model = make_model<3>(text);
  const FluidModel<3> alone(read_scene_text(text), MPI_COMM_SELF);
  auto                state  = model.initial_state();
  auto                serial = alone.initial_state();
  fill_scattered(state.velocity);
  fill_scattered(serial.velocity);
  Projection<3>(model).project(state, 0, 0.1);
  Projection<3>(alone).project(serial, 0, 0.1);
  for (unsigned int axis = 0; axis < 3; ++axis)
    CHECK(largest_over(*model.grid().faces(axis), [&](const GridIndex<3> &face) {
            return std::abs(state.velocity[axis](face) - serial.velocity[axis](face));
          }) < 1e-9);
}
