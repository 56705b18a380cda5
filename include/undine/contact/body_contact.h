// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_contact_body_contact_h
#define undine_contact_body_contact_h

#include <undine/contact/contact_pattern.h>
#include <undine/contact/contact_potential.h>
#include <undine/fluid/model/fluid_model.h>
#include <undine/solid/assembly/contact.h>

#include <vector>

namespace undine
{
  /// Frictionless contact of bodies with each other, with themselves, with obstacles and with plane
  /// walls, by a barrier: the potential of a node of area A at the distance d from another surface
  /// is
  ///
  ///     E = k A D b(d / D),   b(s) = -(s - 1)^2 ln s for s < 1, else 0                     (S16)
  ///
  /// with the activation distance D and the stiffness k of the scene [after Li, Ferguson,
  /// Schneider, Langlois, Zorin, Panozzo, Jiang, Kaufman, ACM Trans. Graph. 39 (2020)]. d is the
  /// distance to the nearest point of a facet, on whose nodes the opposite force is distributed by
  /// that point's weights: forces and moments between bodies cancel, whatever the step. In 3D sharp
  /// edges meet sharp edges too (SharpEdge), by (S17). A body meets itself alike, with a smaller
  /// activation distance where parts of it are close at rest (ActivationDistances).
  template <int dim>
  class BodyContact : public Contact<dim>
  {
  public:
    using Vector        = typename Contact<dim>::Vector;
    using Matrix        = typename Contact<dim>::Matrix;
    using Configuration = typename Contact<dim>::Configuration;

    /// `fluid` and `obstacles`: nullptr if there are none. All references must outlive it.
    /// Collective. Throws InputError.
    BodyContact(const ContactSettings<dim> &settings,
                const SolidModel<dim>      &solid,
                const FluidModel<dim>      *fluid,
                const Obstacles<dim>       *obstacles);

    /// The same where only some bodies move, those of `solid`: `bodies` has been made from all of
    /// them, and displacements are those of these bodies. Collective.
    BodyContact(const BodyContact      &all,
                const SolidModel<dim>  &solid,
                const BodySurface<dim> &bodies);

    /// D [m].
    double
    activation_distance() const
    {
      return settings.activation_distance;
    }

    double
    energy(const Vector &displacement, double time) const override;
    Vector
    forces(const Vector &displacement, double time) const override;
    std::vector<dealii::Tensor<1, dim>>
    nodal_forces(const Vector &displacement, double time) const override;
    void
    add_stiffness(Matrix &A, double factor, const Vector &displacement, double time, Tangent kind)
      const override;
    void
    begin_stage() const override;
    double
    collision_free_fraction(const Configuration &from, const Configuration &to) const override;
    void
    check_start(const Vector &displacement, double time) const override;

    std::string
    note_of_start(const Vector &displacement, double time) const override;
    Columns
    columns(const Vector &displacement, double time) const override;

  private:
    using Positions = typename ContactSurfaces<dim>::Positions;
    using Terms     = std::vector<ContactTerm<dim>>;
    using Forces    = std::vector<dealii::Tensor<1, dim>>;

    Terms
    terms(const Positions &places) const;
    double
    energy(const Terms &terms, const Positions &places) const;
    Forces
    nodal_forces(const Terms &terms, const Positions &places) const;
    ContactPotential<dim>
    potential() const;

    const SolidModel<dim>         &solid; ///< of the bodies that move
    const ContactSurfaces<dim>     surfaces;
    const ContactSettings<dim>     settings; ///< D and k are set
    const ActivationDistances<dim> distances;
    const OwnPairs<dim>            own_pairs;
    mutable ContactPattern<dim>    pattern;
  };
} // namespace undine

#endif
