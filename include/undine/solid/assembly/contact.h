// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_solid_assembly_contact_h
#define undine_solid_assembly_contact_h

#include <undine/base/core/column.h>
#include <undine/base/core/correction_request.h>
#include <undine/base/core/stage.h>
#include <undine/solid/mesh/solid_model.h>

#include <string>
#include <vector>

namespace undine
{
  /// Contact of bodies with each other and with walls: a potential E(d, t) [J] of the positions of
  /// their surfaces, zero where everything is further apart than a given distance, unbounded where
  /// a gap closes, and the paths on which no gap closes. All functions are collective; they give
  /// the same on any number of ranks, up to rounding of the displacement. BodyContact implements
  /// (S16) and (S17).
  template <int dim>
  class Contact
  {
  public:
    using Vector = typename SolidModel<dim>::Vector;
    using Matrix = typename SolidModel<dim>::Matrix;

    virtual ~Contact() = default;

    /// E [J].
    virtual double
    energy(const Vector &displacement, double time) const = 0;

    /// -dE/dd [N], at fixed degrees of freedom too; empty if nothing touches.
    virtual Vector
    forces(const Vector &displacement, double time) const = 0;

    /// -dE/dd in all nodes of the bodies' surfaces, those of bodies that sleep included [N].
    virtual std::vector<dealii::Tensor<1, dim>>
    nodal_forces(const Vector &displacement, double time) const = 0;

    /// A += factor d^2E/dd^2, or what is convex of it, after A has been enlarged by the entries
    /// that this needs.
    virtual void
    add_stiffness(
      Matrix &A, double factor, const Vector &displacement, double time, Tangent kind) const = 0;

    /// A configuration of all bodies at a time.
    struct Configuration
    {
      const Vector &displacement; ///< [m]
      double        time;         ///< [s]
    };

    /// Forgets the entries that earlier stages needed, so that the results of this stage follow
    /// from the state alone, whether a run was resumed or not.
    virtual void
    begin_stage() const = 0;

    /// The largest fraction of the straight path of all nodes on which no gap closes to less than a
    /// fifth of what it was at `from` or, if that is less, a length of the implementation
    /// (BodyContact: half of the activation distance D) [1]; 1 if no gap does.
    virtual double
    collision_free_fraction(const Configuration &from, const Configuration &to) const = 0;

    /// Throws InputError, with a hint, if something overlaps.
    virtual void
    check_start(const Vector &displacement, double time) const = 0;

    /// What pushes already, for a note at the start; empty if nothing does.
    virtual std::string
    note_of_start(const Vector &displacement, double time) const = 0;

    /// For the file `statistics`: energy, least gap, number of contacts, force on every body.
    virtual Columns
    columns(const Vector &displacement, double time) const = 0;
  };


  /// The data that contact needs at the start of a stage (Stage). Forces of contact count for the
  /// whole duration of the stage, by its end alone, and are no rates that later stages use: with
  /// the trapezoidal rule they would produce energy when bodies part.
  struct ContactStart
  {
    /// The last displacement at which no gap was closed [m]; empty: that at which the stage starts.
    dealii::TrilinosWrappers::MPI::Vector displacement;
    double                                time = 0; ///< of that [s]

    /// With which bodies are expected to go on from there [m/s]; empty: nothing touches there, and
    /// the velocity at which the stage starts tells.
    dealii::TrilinosWrappers::MPI::Vector velocity;

    double   weight = 1; ///< kappa: duration over length of the stage [1]
    KeptRate kept   = KeptRate::none;
  };
} // namespace undine

#endif
