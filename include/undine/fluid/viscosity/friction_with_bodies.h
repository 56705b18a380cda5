// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_fluid_viscosity_friction_with_bodies_h
#define undine_fluid_viscosity_friction_with_bodies_h

#include <undine/fluid/viscosity/body_impedance.h>
#include <undine/fluid/viscosity/immersed_viscous_term.h>

#include <deal.II/lac/trilinos_parallel_block_vector.h>

#include <array>

namespace undine
{
  /// Friction and the bodies that it moves, solved together: the equations of ImmersedViscousTerm
  /// along all axes i and (I8),
  ///
  ///     A_i v_i + h K_i P du           = load_i    [kg m/s]
  ///     h Z du - h P^T F(v, u0 + P du) = h load    [kg m/s]
  ///
  /// by flexible GMRES, preconditioned by the block triangle of the A_i and of Z with a damping
  /// that stands for the Schur complement: of each node by itself, or, if that takes too many
  /// iterations, a matrix.
  template <int dim>
  class FrictionWithBodies
  {
  public:
    using Equations = std::array<ImmersedViscousTerm<dim> *, dim>;
    using Vector    = DiffusionSolver::Vector;

    /// `equations`, started with bodies.velocities(), for a step of `dt` [s]. Both must outlive it.
    /// Collective. Throws SolveError.
    FrictionWithBodies(const Equations &equations, BodyImpedance<dim> &bodies, const double dt);

    /// Returns the number of iterations. Throws SolveError. Collective.
    unsigned int
    solve();

    /// After solve() let `velocity` [m/s] be that of the fluid, and the equations find their
    /// forces. Returns the change P du of the velocities of all nodes [m/s]. Collective.
    std::vector<dealii::Tensor<1, dim>>
    finish(Velocity<dim> &velocity) const;

    /// How the fluid resists the motion of each node along each axis, about [kg/s].
    const std::vector<dealii::Tensor<1, dim>> &
    damping() const
    {
      return of_nodes;
    }

  private:
    using BlockVector = dealii::TrilinosWrappers::MPI::BlockVector;
    using Vectors     = std::vector<dealii::Tensor<1, dim>>;

    void
    vmult(BlockVector &result, const BlockVector &x) const;
    void
    precondition(BlockVector &result, const BlockVector &b) const;
    Vectors
    friction_by(const BlockVector &x, const Vectors &change) const;
    BlockVector
    load() const;
    double
    tolerance(const BlockVector &right_side) const;
    unsigned int
    iterate(const BlockVector &right_side, unsigned int most_iterations);
    void
    precondition_by_matrix();

    const Equations     equations;
    BodyImpedance<dim> &bodies;
    const double        dt; ///< [s]
    Vectors             of_nodes;
    BlockVector         x;
  };
} // namespace undine

#endif
