// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_fluid_viscosity_body_impedance_h
#define undine_fluid_viscosity_body_impedance_h

#include <undine/fluid/viscosity/node_damping.h>

#include <deal.II/base/tensor.h>
#include <deal.II/lac/trilinos_vector.h>

#include <array>
#include <vector>

namespace undine
{
  /// How bodies answer to the friction of the fluid around them: their mechanical impedance Z,
  /// force over velocity, and all other forces on them. In a stage they have the velocities u0 + du
  /// with
  ///
  ///     Z du = P^T F + load                                                              (I8)
  ///
  /// F being the forces of friction on the nodes of their surfaces, whose velocities change by P
  /// du. Their degrees of freedom are distributed, nodes of surfaces are known to all ranks. All
  /// functions are collective.
  template <int dim>
  class BodyImpedance
  {
  public:
    using Vector  = dealii::TrilinosWrappers::MPI::Vector;
    using Vectors = std::vector<dealii::Tensor<1, dim>>;

    virtual ~BodyImpedance() = default;

    /// Zero, with a place for every owned degree of freedom.
    virtual Vector
    vector() const = 0;

    /// All forces but F at the velocities u0, inertia among them [N].
    virtual const Vector &
    load() const = 0;

    /// The velocities of all nodes of surfaces by u0 [m/s].
    virtual const Vectors &
    velocities() const = 0;

    /// P du in all nodes of surfaces [m/s].
    virtual Vectors
    on_surfaces(const Vector &change) const = 0;

    /// Add the friction on all nodes that follows from their velocities alone to `forces` [N], the
    /// same on all ranks: load() and force() contain it, F does not.
    virtual void
    add_friction_of_motion(Vectors &forces, const Vectors &velocities) const = 0;

    /// P^T of forces in the nodes, the same on all ranks [N].
    virtual Vector
    on_bodies(const Vectors &forces) const = 0;

    /// Z du [N].
    virtual Vector
    force(const Vector &change) const = 0;

    /// The norm of what rounding makes of force() [N].
    virtual double
    rounding(const Vector &change) const = 0;

    /// Prepare approximate_change() for a fluid whose friction resists the motion of nodes with
    /// `damping` along each axis, the same on all ranks. Throws SolveError.
    virtual void
    prepare(const std::array<NodeDampings, dim> &damping) = 0;

    /// About (Z + damping)^{-1} of forces [m/s]; need not be linear.
    virtual Vector
    approximate_change(const Vector &force) const = 0;
  };
} // namespace undine

#endif
