// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_fluid_viscosity_immersed_viscous_term_h
#define undine_fluid_viscosity_immersed_viscous_term_h

#include <undine/fluid/convection/dual_fluxes.h>
#include <undine/fluid/viscosity/diffusion_solver.h>
#include <undine/fluid/viscosity/viscous_terms.h>

#include <memory>
#include <vector>

namespace undine
{
  /// One implicit Euler step of friction along one axis in a fluid with bodies in it (I5): the
  /// minimum of
  ///
  ///     sum_f rho V_f (v_f - v_f*)^2 / 2 + sum_k m_k (u_k - u_k*)^2 / 2 + h power(v, u) / 2
  ///
  /// over v, and over the velocities u of the nodes of bodies that have a mass; the power is that
  /// of ViscousTerms. Symmetric and positive definite, for pieces of any size and any h. The sum
  /// of rho V v and of h times all forces does not change, to the tolerance of the solver.
  ///
  /// Bodies get the force (I7). The velocities u are auxiliary and not used further: with them the
  /// force stays moderate on bodies that are lighter than the fluid which they drag along.
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
      return open;
    }

    /// v* in `field`, whose ghosts it exchanges, becomes v at `time`; u* are the velocities of the
    /// surfaces' nodes [m/s]. Returns the number of iterations. Throws SolveError. Collective.
    unsigned int
    step(Field<dim>                                &field,
         const std::vector<dealii::Tensor<1, dim>> &node_velocities,
         const double                               time,
         const double                               dt,
         const DualFluxes<dim>                     *fluxes = nullptr);

    /// The forces that step() found, the same on all ranks [N].
    const FrictionForces<double> &
    forces() const
    {
      return last_forces;
    }

    /// Memory of the equations on this rank [bytes].
    std::size_t
    memory_consumption() const;

  private:
    using Vector = DiffusionSolver::Vector;
    using Number = dealii::types::global_dof_index;

    void
    number_unknowns();
    Number
    number(const FacePlace<dim> &place) const;
    void
    set_up(const double dt, const DualFluxes<dim> *fluxes);
    dealii::TrilinosWrappers::SparsityPattern
    pattern(const DualFluxes<dim> *fluxes) const;
    void
    assemble_friction(const double dt);
    void
    add_convection(const DualFluxes<dim> &fluxes);
    void
    find_shrinkage(const DualFluxes<dim> &fluxes);
    double
    diffusion_number() const;
    template <class Action>
    void
    for_each_convective_row(const DualFluxes<dim> &fluxes, const Action &action) const;
    void
    add_given_convection(Vector                &load,
                         const DualFluxes<dim> &fluxes,
                         const Field<dim>      &field) const;
    double
    mass(const FacePlace<dim> &place) const;
    bool
    is_prescribed(const FacePlace<dim> &place) const;
    bool
    is_free(const unsigned int node) const;
    void
    collect(std::vector<std::pair<Number, double>> &free, const ViscousTerm<dim> &term) const;
    double
    given_part(const ViscousTerm<dim> &term, const Field<dim> &field, const double time) const;
    void
    fill(Vector &solution, Vector &load, const Field<dim> &field, const double time) const;
    void
    take_over_free_nodes(const Vector &solution);
    void
    measure_forces(const Field<dim> &field, const double time);

    template <class Action>
    void
    for_each_owned(const Action &action) const;
    template <class Action>
    void
    for_each_viscous_term(const Action &action) const;

    const FluidModel<dim>                           &model;
    const unsigned int                               axis;
    const std::shared_ptr<const FluidTopology<dim>>  open;
    const std::shared_ptr<const NoSlipSurfaces<dim>> no_slip_surfaces;
    const ViscousTerms<dim>                          terms;
    const double                                     viscosity; ///< mu [Pa s]
    Field<dim>                                       numbers;   ///< exact up to 2^53
    dealii::IndexSet                                 mine;
    Number                                           first_node   = 0;
    double                                           assembled_dt = 0; ///< [s]
    DiffusionSolver                                  solver;
    Vector                                           shrinkage; ///< if surfaces move [kg]
    dealii::TrilinosWrappers::SparseMatrix           friction;  ///< of mass and friction
    std::vector<ViscousTerm<dim>> given_terms; ///< in which something is not an unknown face
    std::vector<double>           nodes;       ///< their velocities along the axis [m/s]
    FrictionForces<double>        last_forces;
  };
} // namespace undine

#endif
