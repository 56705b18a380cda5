// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_fluid_implicit_momentum_h
#define undine_fluid_implicit_momentum_h

#include <undine/fluid/fluid_stage.h>
#include <undine/fluid/viscosity/friction_with_bodies.h>
#include <undine/fluid/viscosity/implicit_diffusion.h>

#include <array>
#include <functional>
#include <memory>
#include <string>

namespace undine
{
  /// The implicit step of a stage for friction and, where it has one, the flux form of convection
  /// (F13) together, between the borrowing and the giving back of the old pressure gradient:
  ///
  ///     w + g C w - g nu Laplace w = v'' - g grad q / rho,   v* = w + g grad q / rho
  ///
  /// Keeps the equations of friction as long as surfaces and step do not change.
  template <int dim>
  class ImplicitMomentum
  {
  public:
    using Action = std::function<void(Velocity<dim> &)>;

    /// v'' in the state becomes v*; forces on surfaces and sides come to `step.friction`. `use_w`
    /// is called for w, `effect` is the name by which memory is accounted for. Throws SolveError.
    /// Collective.
    void
    solve(
      FluidStage<dim> &step, const std::string &effect, const Action &use_w = [](Velocity<dim> &) {
      });

    /// Of the equations on this rank [bytes].
    std::size_t
    memory_consumption() const;

  private:
    bool
    relax(FluidStage<dim> &step);
    void
    solve_among_surfaces(FluidStage<dim> &step);
    void
    solve_with_bodies(FluidStage<dim>                                   &step,
                      const typename FrictionWithBodies<dim>::Equations &all);
    ImplicitDiffusion<dim> &
    diffusion(const FluidStage<dim> &step, unsigned int axis);
    ImmersedViscousTerm<dim> &
    equation(const FluidStage<dim> &step, unsigned int axis);

    /// Without surfaces. @{
    std::array<std::unique_ptr<VelocityCondition<dim>>, dim> conditions;
    std::array<std::unique_ptr<ImplicitDiffusion<dim>>, dim> diffusions;
    /// @}
    /// All else. @{
    std::array<std::unique_ptr<ImmersedViscousTerm<dim>>, dim> equations;
    std::shared_ptr<const FluidTopology<dim>>                  nothing_cut;
    std::shared_ptr<const NoSlipSurfaces<dim>>                 no_surfaces;
    /// @}
  };
} // namespace undine

#endif
