// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_contact_contact_potential_h
#define undine_contact_contact_potential_h

#include <undine/contact/contact_terms.h>

#include <array>
#include <vector>

namespace undine
{
  /// Matrices between the nodes of a term: [i][j], i and j < n.
  template <int dim>
  using NodeMatrices = std::array<std::array<dealii::Tensor<2, dim>, dim + 1>, dim + 1>;

  /// The potential energy of a term of contact, and its derivatives with respect to the positions
  /// of its nodes:
  ///
  ///     E = k A D m(c) b(d / D)                                                       (S16), (S17)
  template <int dim>
  class ContactPotential
  {
  public:
    using Term      = ContactTerm<dim>;
    using Positions = typename ContactSurfaces<dim>::Positions;

    /// k [Pa].
    explicit ContactPotential(const double stiffness)
      : stiffness(stiffness)
    {
    }

    /// E [J].
    double
    energy(const Term &term, const Positions &places) const;

    /// -dE/dx_i [N], for each node.
    std::array<dealii::Tensor<1, dim>, dim + 1>
    forces(const Term &term, const Positions &places) const;

    /// d^2E / dx_i dx_j [N/m].
    NodeMatrices<dim>
    second_derivatives(const Term &term, const Positions &places) const;

    /// Of these the part E''(d) dd/dx_i dd/dx_j, by which normal motions are resisted: without that
    /// which lets surfaces that press on each other slip. Not less than zero in the sum of terms of
    /// flat and convex surfaces (Gauss and Newton's approximation) [N/m].
    NodeMatrices<dim>
    convex_part(const Term &term, const Positions &places) const;

  private:
    double stiffness;
  };
} // namespace undine

#endif
