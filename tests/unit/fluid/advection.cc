// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/advection/advection.h>
#include <undine/fluid/model/fluid_quantities.h>

#include <catch2/catch.hpp>
#include <fluid/fluid_scene.h>

using namespace undine_tests;

namespace
{
  const std::vector<std::string> methods{"semi-Lagrangian", "MacCormack", "cubic"};


  /// A scalar that is 1 in whatever comes in.
  template <int dim>
  class Dye : public BoundaryCondition<dim>
  {
  public:
    bool
    is_dirichlet(const Boundary<dim> &boundary) const override
    {
      return boundary.kind == BoundaryKind::inflow;
    }

    double
    dirichlet_value(const Boundary<dim> &,
                    const unsigned int,
                    const dealii::Point<dim> &,
                    const double) const override
    {
      return 1;
    }

    double
    entering_value(const dealii::Point<dim> &, const double) const override
    {
      return 1;
    }

    bool
    obeys_maximum_principle() const override
    {
      return true;
    }
  };


  template <int dim, class Function>
  Field<dim>
  make_field(const std::shared_ptr<const Lattice<dim>> &lattice, const Function &function)
  {
    Field<dim> field(lattice);
    for_each(field.owned(),
             [&](const GridIndex<dim> &index) { field(index) = function(lattice->point(index)); });
    return field;
  }


  double
  bump(const dealii::Point<2> &place)
  {
    const double distance = place.distance(dealii::Point<2>(0.5, 0.7));
    return distance < 0.3 ? std::pow(std::cos(dealii::numbers::PI / 0.6 * distance), 4) : 0.;
  }


  /// One rigid turn about the centre in 2 n steps, n cells a side: the field and its error.
  struct Turn
  {
    double error;    ///< sqrt of the mean square
    double drift;    ///< of the integral, relative
    double smallest; ///< values
    double largest;
  };


  Turn
  turn(const std::string &method, const unsigned int n, const std::string &grading)
  {
    const auto model =
      make_model<2>(FluidText{fmt::format("{}, {}", n, n),
                              "",
                              "0.5-y; x-0.5",
                              "set Grading x = " + grading + "\nset Grading y = " + grading});
    const auto                    advection = Registry<Advection<2>>::instance().make(method);
    const auto                    velocity  = model.initial_state().velocity;
    const int                     steps     = 2 * n;
    const double                  dt        = 2 * dealii::numbers::PI / steps;
    const CharacteristicTracer<2> tracer(model, velocity, 0, dt);
    const auto                    start = make_field<2>(model.grid().cells(), bump);
    auto                          field = start;
    for (int step = 0; step < steps; ++step)
      field = advection->advect(tracer, field, Dye<2>());
    Turn result;
    result.error   = std::sqrt(sum_over(field.lattice(), [&](const GridIndex<2> &cell) {
      return model.grid().cell_volume(cell) * std::pow(field(cell) - start(cell), 2);
    }));
    result.drift   = std::abs(integral(model, field) / integral(model, start) - 1);
    result.largest = largest_over(field.lattice(), [&](const auto &cell) { return field(cell); });
    result.smallest =
      -largest_over(field.lattice(), [&](const auto &cell) { return -field(cell); });
    return result;
  }
} // namespace


TEST_CASE("MacCormack advects a smooth bump around with second order, semi-Lagrangian with first",
          "[advection]")
{
  for (const std::string grading : {"x", "x+0.1*sin(2*pi*x)/(2*pi)"})
    {
      const auto coarse = turn("MacCormack", 48, grading);
      const auto fine   = turn("MacCormack", 96, grading);
      INFO("errors " << coarse.error << ", " << fine.error);
      CHECK(std::log2(coarse.error / fine.error) > 1.8);
      const auto blurred = turn("semi-Lagrangian", 48, grading);
      const auto sharper = turn("semi-Lagrangian", 96, grading);
      INFO("semi-Lagrangian errors " << blurred.error << ", " << sharper.error);
      CHECK(std::log2(blurred.error / sharper.error) > 0.5);
      CHECK(fine.error < 0.15 * sharper.error);
      // Neither conserves the integral exactly; its drift vanishes with the orders of the errors.
      INFO("drifts " << coarse.drift << ", " << fine.drift << ", " << blurred.drift << ", "
                     << sharper.drift);
      CHECK(std::log2(coarse.drift / fine.drift) > 1.8);
      CHECK(std::log2(blurred.drift / sharper.drift) > 0.8);
    }
}


TEST_CASE("advected fields stay between their bounds", "[advection][mpi]")
{
  for (const auto &method : methods)
    {
      const auto model =
        make_model<2>(FluidText{"30, 30", "", "sin(pi*x)*cos(pi*y); -cos(pi*x)*sin(pi*y)"});
      const auto                    advection = Registry<Advection<2>>::instance().make(method);
      const CharacteristicTracer<2> tracer(model, model.initial_state().velocity, 0, 0.1);
      auto field = make_field<2>(model.grid().cells(), [](const auto &place) {
        return place[0] > 0.5 && place[1] < 0.3 ? 1. : -1.;
      });
      for (unsigned int step = 0; step < 20; ++step)
        field = advection->advect(tracer, field, Dye<2>());
      CHECK(largest_over(field.lattice(),
                         [&](const auto &cell) { return std::abs(field(cell)); }) <= 1 + 1e-14);
    }
}


TEST_CASE("linear fields are advected exactly by uniform flow, at any Courant number",
          "[advection][mpi]")
{
  for (const auto &method : methods)
    for (const double dt : {0.01, 0.3, 0.8})
      {
        const auto model =
          make_model<3>(FluidText{"9, 6, 5",
                                  boundary("in", "left", "inflow", "set Velocity = 1; 0; 0") +
                                    boundary("out", "right", "outflow"),
                                  "1; 0; 0",
                                  "set Grading x = x^1.4"});
        const auto                    advection = Registry<Advection<3>>::instance().make(method);
        const CharacteristicTracer<3> tracer(model, model.initial_state().velocity, 0, dt);
        const auto                    start =
          make_field<3>(model.grid().cells(), [](const auto &place) { return 1 - place[0]; });
        const auto advected = advection->advect(tracer, start, Dye<3>());
        // Beyond the outflow the field goes on as a constant, which the way back of MacCormack
        // sees.
        CHECK(largest_over(advected.lattice(), [&](const GridIndex<3> &cell) {
                const double x       = model.grid().cells()->point(cell)[0];
                const double width   = model.grid().cell_width(0, 8);
                const bool   is_near = method != "semi-Lagrangian" && x + dt > 1 - 3 * width;
                return is_near ? 0. : std::abs(advected(cell) - std::min(1., 1 - x + dt));
              }) < 1e-12);
      }
}


TEST_CASE("periodic fields travel around and come back", "[advection][mpi]")
{
  for (const auto &method : methods)
    for (const double dt : {0.125, 2.375})
      {
        const auto model = make_model<2>(
          FluidText{"16, 8", boundary("around", every_side<2>(), "periodic"), "1; -2"});
        const auto                    advection = Registry<Advection<2>>::instance().make(method);
        const CharacteristicTracer<2> tracer(model, model.initial_state().velocity, 0, dt);
        for (unsigned int axis = 0; axis < 2; ++axis)
          {
            const auto start = make_field<2>(model.grid().faces(axis), [](const auto &place) {
              return std::sin(2 * dealii::numbers::PI * place[0]) +
                     std::cos(2 * dealii::numbers::PI * place[1]);
            });
            auto       field = start;
            for (unsigned int step = 0; step < 8; ++step)
              field = advection->advect(tracer, field, VelocityCondition<2>(axis));
            CHECK(largest_over(field.lattice(), [&](const auto &face) {
                    return std::abs(field(face) - start(face));
                  }) < 1e-11);
          }
      }
}


TEST_CASE("advected fields do not depend on the number of ranks", "[advection][mpi]")
{
  for (const auto &method : methods)
    {
      const std::string   text  = FluidText{"20, 14",
                                         boundary("in", "left", "inflow", "set Velocity = 1; 0.3") +
                                           boundary("out", "right, top", "outflow"),
                                         "1+y; sin(7*x)",
                                         "set Grading y = x^1.2"};
      const auto          model = make_model<2>(text);
      const FluidModel<2> alone(read_scene_text(text), MPI_COMM_SELF);
      const auto          advection = Registry<Advection<2>>::instance().make(method);
      const auto          advect    = [&](const FluidModel<2> &where) {
        const CharacteristicTracer<2> tracer(where, where.initial_state().velocity, 0, 0.2);
        Field<2>                      field(where.grid().cells());
        fill_scattered(field, 4);
        return advection->advect(tracer, field, Dye<2>());
      };
      const auto parallel = advect(model);
      const auto serial   = advect(alone);
      CHECK(largest_over(parallel.lattice(), [&](const GridIndex<2> &cell) {
              return std::abs(parallel(cell) - serial(cell));
            }) < 1e-13);
    }
}


TEST_CASE("fields that are advected together are advected as each of them alone",
          "[advection][mpi]")
{
  for (const auto &method : methods)
    {
      const auto model =
        make_model<3>(FluidText{"9, 8, 7",
                                boundary("in", "left", "inflow", "set Velocity = 1; 0.3; 0") +
                                  boundary("out", "right, top", "outflow"),
                                "1+y; sin(7*x); cos(5*y)"});
      const auto                    advection = Registry<Advection<3>>::instance().make(method);
      const CharacteristicTracer<3> tracer(model, model.initial_state().velocity, 0, 0.2);
      std::vector<Field<3>>         fields(3, Field<3>(model.grid().cells()));
      for (std::size_t k = 0; k < fields.size(); ++k)
        fill_scattered(fields[k], 4 + k);
      const auto together =
        advection->advect(tracer, fields, {std::vector<double>(fields.size(), 0.)}, Dye<3>());
      REQUIRE(together.size() == fields.size());
      for (std::size_t k = 0; k < fields.size(); ++k)
        {
          const auto alone = advection->advect(tracer, fields[k], Dye<3>());
          CHECK(largest_over(alone.lattice(), [&](const GridIndex<3> &cell) {
                  return std::abs(together[k](cell) - alone(cell));
                }) == 0);
        }
    }
}


TEST_CASE("paths end at openings and slide along walls", "[advection]")
{
  const auto                    model = make_model<2>(FluidText{
    "10, 10",
    boundary("in", "left", "inflow", "set Velocity = 1; 0") + boundary("out", "right", "outflow"),
    "1; 0.5"});
  const CharacteristicTracer<2> tracer(model, model.initial_state().velocity, 0, 1);
  const auto                    back = tracer.trace({0.25, 0.5}, -1);
  CHECK(back.left_domain);
  CHECK(back.foot.point[0] == Approx(0).margin(1e-14));
  CHECK(back.foot.point[1] == Approx(0.5 - 0.125));
  const auto up = tracer.trace({0.2, 0.95}, 0.4);
  CHECK_FALSE(up.left_domain);
  CHECK(up.foot.point[0] == Approx(0.6));
  CHECK(up.foot.point[1] == 1);
}


TEST_CASE("steps that travel absurdly far are refused", "[advection]")
{
  const auto model = make_model<2>(FluidText{"4, 4", "", "1; 0"});
  CHECK_THROWS_AS(CharacteristicTracer<2>(model, model.initial_state().velocity, 0, 1e3),
                  SolveError);
}
