// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/model/fluid_quantities.h>
#include <undine/fluid/viscosity/implicit_diffusion.h>

#include <catch2/catch.hpp>
#include <fluid/fluid_scene.h>

using namespace undine_tests;

namespace
{
  /// Prescribed at one boundary named "hot", free elsewhere.
  template <int dim>
  class Heat : public BoundaryCondition<dim>
  {
  public:
    bool
    is_dirichlet(const Boundary<dim> &boundary) const override
    {
      return boundary.name == "hot";
    }

    double
    dirichlet_value(const Boundary<dim> &,
                    const unsigned int,
                    const dealii::Point<dim> &place,
                    const double              time) const override
    {
      return time + place[1];
    }

    double
    entering_value(const dealii::Point<dim> &, const double) const override
    {
      return 0;
    }

    bool
    obeys_maximum_principle() const override
    {
      return true;
    }
  };


  /// Error of one step from `mode`, an eigenfunction: the exact result is mode / (1 + h nu k^2).
  template <class Mode>
  double
  error_of_step(const FluidText &text,
                const std::shared_ptr<const Lattice<2>> &(*lattice)(const FluidModel<2> &),
                const BoundaryCondition<2> &condition,
                const double                square_wave_number,
                const Mode                 &mode)
  {
    const auto model = make_model<2>(text);
    Field<2>   field(lattice(model));
    for_each(field.owned(),
             [&](const GridIndex<2> &index) { field(index) = mode(field.lattice().point(index)); });
    ImplicitDiffusion<2>(model, lattice(model), condition, 0.3).step(field, 0.2, 0.2);
    return largest_over(field.lattice(), [&](const GridIndex<2> &index) {
      return std::abs(field(index) -
                      mode(field.lattice().point(index)) / (1 + 0.2 * 0.3 * square_wave_number));
    });
  }
} // namespace


TEST_CASE("diffusion of scalars is of second order, on graded grids too", "[diffusion][mpi]")
{
  const auto error = [](const unsigned int n, const std::string &grading) {
    return error_of_step(
      FluidText{fmt::format("{}, {}", n, n), "", "", "set Grading x = " + grading},
      +[](const FluidModel<2> &model) -> const std::shared_ptr<const Lattice<2>> & {
        return model.grid().cells();
      },
      Heat<2>(),
      5 * pi * pi,
      [](const auto &place) { return std::cos(pi * place[0]) * std::cos(2 * pi * place[1]); });
  };
  CHECK(std::log2(error(16, "x") / error(32, "x")) > 1.9);
  const std::string graded = "x+0.3*sin(2*pi*x)/(2*pi)";
  CHECK(std::log2(error(16, graded) / error(32, graded)) > 1.8);
}


TEST_CASE("friction on walls is of second order for each component", "[diffusion][mpi]")
{
  const auto error = [](const unsigned int n) {
    return error_of_step(
      FluidText{fmt::format("{}, {}", n, n), boundary("wall", every_side<2>(), "no-slip wall")},
      +[](const FluidModel<2> &model) -> const std::shared_ptr<const Lattice<2>> & {
        return model.grid().faces(0);
      },
      VelocityCondition<2>(0),
      5 * pi * pi,
      [](const auto &place) { return std::sin(pi * place[0]) * std::sin(2 * pi * place[1]); });
  };
  CHECK(std::log2(error(16) / error(32)) > 1.9);
}


TEST_CASE("a Dirichlet wall draws the field to its value, the sum changes by the flux only",
          "[diffusion][mpi]")
{
  const auto model = make_model<3>(FluidText{"5, 6, 4", boundary("hot", "left", "slip wall")});
  Field<3>   field(model.grid().cells());
  fill_scattered(field, 2);
  const Heat<3>        heat;
  ImplicitDiffusion<3> diffusion(model, model.grid().cells(), heat, 1.);
  for (unsigned int step = 0; step < 12; ++step)
    diffusion.step(field, 3., 10.);
  CHECK(largest_over(field.lattice(), [&](const GridIndex<3> &cell) {
          return std::abs(field(cell) - 3 - field.lattice().point(cell)[1]);
        }) < 0.6);

  const auto closed = make_model<3>(FluidText{"5, 6, 4", "", "", "set Grading z = x^2"});
  Field<3>   other(closed.grid().cells());
  fill_scattered(other, 2);
  const double         before = integral(closed, other);
  ImplicitDiffusion<3> free(closed, closed.grid().cells(), heat, 1.);
  free.step(other, 0., 0.1);
  CHECK(integral(closed, other) == Approx(before).margin(1e-11));
}
