// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_fluid_viscosity_immersed_viscous_term_h
#define undine_fluid_viscosity_immersed_viscous_term_h

#include <undine/fluid/viscosity/convective_term.h>
#include <undine/fluid/viscosity/diffusion_solver.h>
#include <undine/fluid/viscosity/node_damping.h>
#include <undine/fluid/viscosity/viscous_terms.h>

#include <memory>
#include <vector>

namespace undine
{
  /// One implicit Euler step of friction, and of convection in flux form, along one axis in a fluid
  /// with bodies in it (I5): without convection the minimum of
  ///
  ///     sum_f rho V_f (v_f - v_f*)^2 / 2 + h power(v, u) / 2
  ///
  /// over v, the power being that of ViscousTerms. Symmetric and positive definite, for pieces of
  /// any size and any h. The velocities u of the nodes of surfaces are given, or change together
  /// with v (FrictionWithBodies). The sum of rho V v and of h times all forces does not change, to
  /// the tolerance of the solver.
  template <int dim>
  class ImmersedViscousTerm
  {
  public:
    /// `viscosity` mu [Pa s]. The model must outlive it. Collective.
    ImmersedViscousTerm(const FluidModel<dim>                     &model,
                        const unsigned int                         axis,
                        std::shared_ptr<const FluidTopology<dim>>  open,
                        std::shared_ptr<const NoSlipSurfaces<dim>> walls,
                        const double                               viscosity);

    /// The surfaces for which it was set up.
    const std::shared_ptr<const NoSlipSurfaces<dim>> &
    walls() const
    {
      return no_slip_surfaces;
    }

    /// The topology of the fluid for which it was set up.
    const std::shared_ptr<const FluidTopology<dim>> &
    topology() const
    {
      return unknowns.topology();
    }

    using Vector = DiffusionSolver::Vector;

    /// Of all nodes of surfaces along the axis: velocities [m/s], or forces [N].
    using Motion = std::vector<double>;

    /// Prepare the step of `dt` [s] to `time` [s] from v* in `field`, whose ghosts it exchanges;
    /// the nodes have `node_velocities` [m/s]. Collective.
    void
    start(Field<dim>                                &field,
          const std::vector<dealii::Tensor<1, dim>> &node_velocities,
          const double                               time,
          const double                               dt,
          const DualFluxes<dim>                     *fluxes);

    /// v*, a first v [m/s].
    const Vector &
    guess() const
    {
      return first;
    }

    /// v for nodes that keep their velocities, from what `solution` is. Returns the number of
    /// iterations. Throws SolveError. Collective.
    unsigned int
    solve(Vector &solution) const;

    /// The equations A v + h K u = load for nodes that change their velocities by u. @{
    const Vector &
    load() const
    {
      return right_side;
    }

    /// A v + h K u [kg m/s].
    void
    vmult(Vector &result, const Vector &v, const Motion &u) const;

    /// The friction on all nodes by v, with zero on prescribed faces, and u alone [N].
    Motion
    friction_by(const Vector &v, const Motion &u) const;

    /// The friction on all nodes by what is given, the velocities of start() among it [N].
    Motion
    given_friction() const;

    /// About A^{-1}; by its diagonal or by factors, see DiffusionSolver, until start(). @{
    void
    precondition(Vector &v, const Vector &b) const
    {
      solver.precondition(v, b);
    }
    void
    precondition_by_diagonal()
    {
      is_replaced = true;
      solver.precondition_by_diagonal();
    }
    void
    precondition_by_factors()
    {
      is_replaced = true;
      solver.precondition_by_factors();
    }
    /// @}

    /// An estimate of the resistance of the fluid to the motion of the nodes as a matrix, and the
    /// sums of the sizes in its rows [kg/s]. The same on all ranks. Collective. @{
    NodeDampings
    damping_matrix() const;
    Motion
    damping() const;
    /// @}
    /// @}

    /// v becomes `solution`, and the velocities of nodes change; finds the forces. Collective.
    void
    finish(Field<dim> &field, const Vector &solution, const Motion &change_of_nodes = {});

    /// The forces that finish() found, the same on all ranks [N].
    const FrictionForces<double> &
    forces() const
    {
      return last_forces;
    }

    /// Memory of the equations on this rank [bytes].
    std::size_t
    memory_consumption() const;

  private:
    using Number = typename FaceUnknowns<dim>::Number;

    /// Call `action(term, weight)` for the terms with nodes, `weight` being what the fluid leaves
    /// of that of the term [kg/s].
    template <class Action>
    void
    for_each_damping(const Action &action) const;

    void
    set_up_friction(const double dt, const DualFluxes<dim> *fluxes);
    void
    make_pattern(const DualFluxes<dim> *fluxes);
    void
    assemble_friction(const double dt);
    double
    diffusion_number() const;
    void
    collect(std::vector<std::pair<Number, double>> &free, const ViscousTerm<dim> &term) const;
    static double
    by_nodes(const ViscousTerm<dim> &term, const Motion &of_nodes);
    double
    given_part(const ViscousTerm<dim> &term, const Field<dim> &field) const;
    void
    fill(const Field<dim> &field);
    void
    measure_forces(const Field<dim> &field);

    template <class Action>
    void
    for_each_viscous_term(const Action &action) const;

    const FluidModel<dim>                           &model;
    const unsigned int                               axis;
    const FaceUnknowns<dim>                          unknowns;
    const std::shared_ptr<const NoSlipSurfaces<dim>> no_slip_surfaces;
    const ViscousTerms<dim>                          terms;
    const double                                     viscosity;        ///< mu [Pa s]
    double                                           assembled_dt = 0; ///< [s]
    double                                           time         = 0; ///< [s]
    bool                                             is_replaced  = false;
    DiffusionSolver                                  solver;
    ConvectiveTerm<dim>                              convection;
    dealii::TrilinosWrappers::SparseMatrix           friction; ///< of mass and friction
    std::vector<ViscousTerm<dim>> given_terms; ///< in which something is not an unknown face
    Motion                        nodes;       ///< their velocities [m/s]
    Vector                        first;
    Vector                        right_side;
    Motion                        by_given; ///< this rank's part of given_friction() [N]
    FrictionForces<double>        last_forces;
  };
} // namespace undine

#endif
