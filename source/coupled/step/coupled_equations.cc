// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/core/relative.h>
#include <undine/base/parallel/interruption.h>
#include <undine/base/parallel/rounding.h>
#include <undine/coupled/step/coupled_equations.h>
#include <undine/solid/assembly/prescribed_motion.h>
#include <undine/solid/assembly/sparse.h>

#include <algorithm>
#include <cmath>

namespace undine
{
  template <int dim>
  CoupledEquations<dim>::CoupledEquations(const SolidModel<dim>        &model,
                                          SolidEquations<dim>          &solid,
                                          SurfaceFlux<dim>             &surface,
                                          const FollowerPressure<dim>  &follower,
                                          const PressureEquations<dim> &fluid,
                                          BlockSolver<dim>             &solver,
                                          TimingTree                   &timing,
                                          const double                  rounding_of_places)
    : model(model)
    , solid(solid)
    , surface(surface)
    , follower(follower)
    , fluid(fluid)
    , solver(solver)
    , timing(timing)
    , rounding_of_places(rounding_of_places)
  {
    residual = vector();
  }


  template <int dim>
  typename CoupledEquations<dim>::Unknown
  CoupledEquations<dim>::vector() const
  {
    return Unknown({model.locally_owned(), fluid.numbers().owned()}, model.communicator());
  }


  template <int dim>
  double
  CoupledEquations<dim>::evaluate(const Unknown &x)
  {
    const auto timed = timing.section("evaluate");
    surface.move(x.block(0));
    auto pushing = forces(x);
    clear_fixed(pushing, model);
    residual.block(0) = solid.residual(x.block(0));
    residual.block(0).add(-1., pushing);

    const auto swept = fluid.from_components(surface.fluxes());
    fluid.matrix().vmult(residual.block(1), x.block(1));
    const double by_pressure = residual.block(1).l2_norm();
    residual.block(1).add(1., swept, 1., fluid.predicted_flux());
    fluid.closed_regions().balance(residual.block(1));

    // What rounding leaves counts as converged.
    const double tolerance = model.numerics().newton.relative_tolerance;
    flux_rounding          = rounding_of_places + rounding_of_product(fluid.matrix(), x.block(1));
    measure({std::max({solid.scale(), pushing.l2_norm(), solid.rounding() / tolerance}),
             std::max({by_pressure,
                       swept.l2_norm(),
                       fluid.predicted_flux().l2_norm(),
                       flux_rounding / tolerance})});
    return std::hypot(relative(residual.block(0).l2_norm(), here.force),
                      relative(residual.block(1).l2_norm(), here.flux));
  }


  template <int dim>
  typename CoupledEquations<dim>::Vectors
  CoupledEquations<dim>::nodal_forces(const Unknown &x) const
  {
    auto       result = surface.nodal_forces(fluid.field(x.block(1)));
    const auto add    = [&](const Vectors &more) {
      for (std::size_t node = 0; node < more.size(); ++node)
        result[node] += more[node];
    };
    add(surface.change_at_rest());
    if (follower.is_on())
      add(follower.forces(solid.displacement(x.block(0))));
    return result;
  }


  template <int dim>
  typename CoupledEquations<dim>::Vector
  CoupledEquations<dim>::forces(const Unknown &x) const
  {
    return surface.on_bodies(nodal_forces(x));
  }


  template <int dim>
  void
  CoupledEquations<dim>::start()
  {
    reference = {};
  }


  template <int dim>
  void
  CoupledEquations<dim>::measure(const Sizes &own)
  {
    const auto limited = [](const double size, const double known) {
      return known == 0 ? size : std::clamp(size, known, 10 * known);
    };
    here.force = limited(own.force, reference.force);
    here.flux  = limited(own.flux, reference.flux);
  }


  template <int dim>
  void
  CoupledEquations<dim>::linearise(const Unknown &x, const Tangent kind)
  {
    const auto &velocity     = x.block(0);
    const auto  displacement = solid.displacement(velocity);
    tangent = std::make_unique<BlockSystem::Matrix>(solid.jacobian(velocity, kind));
    // Pressures on surfaces that turn have a stiffness that may be negative: none in convex ones.
    const bool is_exact = kind == Tangent::exact;
    if (is_exact && follower.is_on())
      follower.subtract_stiffness(*tangent, solid.displacement_factor(), displacement);
    if (is_exact && surface.has_stiffness())
      surface.subtract_stiffness(*tangent, fluid.field(x.block(1)));
    if (is_exact && (follower.is_on() || surface.has_stiffness()))
      fix_rows_and_columns(*tangent, model.all_fixed());
    const auto timed = timing.section("solve linear system");
    system           = std::make_unique<const BlockSystem>(
      *tangent, surface.matrix(), surface.factor(), fluid.matrix());
    solver.initialize(*system, displacement);
  }


  template <int dim>
  typename CoupledEquations<dim>::Unknown
  CoupledEquations<dim>::correction(const Unknown &x, const CorrectionRequest &request)
  {
    reference = here;
    throw_if_interrupted(model.communicator());
    if (request.new_tangent)
      linearise(x, request.tangent);
    const auto timed  = timing.section("solve linear system");
    auto       result = solver.solve(residual, request.reduction);
    result *= -1.;
    timing.memory.hold_briefly("two-way coupling",
                               surface.matrix().memory_consumption() +
                                 fluid.matrix().memory_consumption() + solver.memory_consumption());
    const double part = solid.collision_free_fraction(x.block(0), result.block(0));
    if (part < 1)
      result *= part;
    return result;
  }


  template <int dim>
  double
  CoupledEquations<dim>::slope(const Unknown &correction) const
  {
    return residual.block(0) * correction.block(0);
  }


  template <int dim>
  double
  CoupledEquations<dim>::part_left() const
  {
    return solver.part_left();
  }


  template <int dim>
  double
  CoupledEquations<dim>::scale() const
  {
    return 1;
  }


  template <int dim>
  double
  CoupledEquations<dim>::rounding() const
  {
    return std::hypot(relative(solid.rounding(), here.force), relative(flux_rounding, here.flux));
  }


  template <int dim>
  unsigned int
  CoupledEquations<dim>::linear_iterations() const
  {
    return solver.iterations();
  }


  template class CoupledEquations<2>;
  template class CoupledEquations<3>;
} // namespace undine
