// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/boundary/boundary_quantities.h>
#include <undine/fluid/viscosity/immersed_viscous_term.h>
#include <undine/fluid/viscosity/implicit_diffusion.h>

#include <catch2/catch.hpp>
#include <fluid/fluid_scene.h>

using namespace undine_tests;

namespace
{
  /// By how much the results of relaxation and of the matrix of ImmersedViscousTerm differ at most,
  /// of a step in which a scattered flow carries itself, in cells `number` of which the friction
  /// reaches over.
  template <int dim>
  double
  difference_from_matrix(const std::string &text, const double number, const bool with_convection)
  {
    constexpr double dt = 0.02, time = 0.3;
    const auto       model     = make_model<dim>(text);
    const double     width     = 1. / model.grid().cells_along()[0];
    const double     viscosity = model.density() * number * width * width / dt;
    Velocity<dim>    velocity;
    for (unsigned int axis = 0; axis < dim; ++axis)
      velocity[axis] = Field<dim>(model.grid().faces(axis));
    fill_scattered(velocity);
    set_boundary_velocity(velocity, model.boundaries(), time);
    const DualFluxes<dim> fluxes(model, velocity, time);
    const auto           *carrying = with_convection ? &fluxes : nullptr;
    const auto            uncut    = std::make_shared<const FluidTopology<dim>>();
    const auto            no_walls = std::make_shared<const NoSlipSurfaces<dim>>();
    double                largest  = 0;
    for (unsigned int axis = 0; axis < dim; ++axis)
      {
        auto                         relaxed = velocity[axis], solved = velocity[axis];
        const VelocityCondition<dim> condition(axis);
        ImplicitDiffusion<dim>       diffusion(
          model, model.grid().faces(axis), condition, viscosity / model.density());
        REQUIRE(diffusion.relax(relaxed, time, dt, carrying));
        ImmersedViscousTerm<dim> equations(model, axis, uncut, no_walls, viscosity);
        equations.start(solved, {}, time, dt, carrying);
        auto solution = equations.guess();
        equations.solve(solution);
        equations.finish(solved, solution);
        largest =
          std::max(largest, largest_over(relaxed.lattice(), [&](const GridIndex<dim> &face) {
                     return std::abs(relaxed(face) - solved(face));
                   }));
      }
    return largest;
  }


  const std::string channel = boundary("walls", "bottom", "no-slip wall") +
                              boundary("lid", "top", "moving wall", "set Velocity = 1; 0") +
                              boundary("entry", "left", "inflow", "set Velocity = y*(1-y); 0") +
                              boundary("exit", "right", "outflow");
} // namespace


TEST_CASE("relaxation of friction and convection solves the equations of the matrix",
          "[diffusion][mpi]")
{
  const bool with_convection = GENERATE(false, true);
  CAPTURE(with_convection);
  CHECK(difference_from_matrix<2>(FluidText{"12, 10", channel, "", "", 1.5}, 1, with_convection) <
        1e-10);
  CHECK(difference_from_matrix<2>(
          FluidText{"12, 10", channel, "", "set Grading y = x+0.3*sin(2*pi*x)/(2*pi)", 3},
          0.2,
          with_convection) < 1e-10);
  CHECK(difference_from_matrix<2>(FluidText{"9, 8", boundary("around", "left, right", "periodic")},
                                  2,
                                  with_convection) < 1e-10);
  CHECK(difference_from_matrix<3>(
          FluidText{"6, 7, 5", boundary("walls", "left, bottom, back", "no-slip wall"), "", "", 2},
          0.5,
          with_convection) < 1e-10);
}


TEST_CASE("relaxation leaves to others what reaches over many cells", "[diffusion][mpi]")
{
  const auto model = make_model<2>(FluidText{"10, 10"});
  Field<2>   field(model.grid().faces(0));
  fill_scattered(field, 1);
  const auto                 before = field;
  const VelocityCondition<2> condition(0);
  ImplicitDiffusion<2>       diffusion(model, model.grid().faces(0), condition, 1.);
  CHECK_FALSE(diffusion.relax(field, 0., 1., nullptr));
  CHECK(largest_over(field.lattice(), [&](const GridIndex<2> &face) {
          return std::abs(field(face) - before(face));
        }) == 0);
}
