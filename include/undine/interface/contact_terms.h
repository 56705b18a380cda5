// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_interface_contact_terms_h
#define undine_interface_contact_terms_h

#include <undine/interface/contact_surfaces.h>
#include <undine/interface/nearest_in_simplex.h>

#include <array>
#include <vector>

namespace undine
{
  /// A node near a simplex of another surface, or near a wall.
  template <int dim>
  struct ContactTerm
  {
    static constexpr unsigned int no_wall = -1;

    unsigned int                      n = 1;     ///< nodes: the node, then those of the simplex
    std::array<unsigned int, dim + 1> nodes{};   ///< n of them are used
    std::array<double, dim + 1>       shares{};  ///< 1, then minus the weights of the nearest point
    dealii::Tensor<1, dim>            direction; ///< from the nearest point to the node, length 1
    double                            distance = 0; ///< [m]
    double                            area     = 0; ///< on which it acts, negative if it is taken
                                                    ///< off what others count twice [m^(dim-1)]
    unsigned int wall = no_wall;
  };

  /// All that are nearer than `gap` [m], in an order that the places alone decide; those of every
  /// node with all facets less ridges plus corners (in 2D facets less ends), so that a flat or
  /// convex surface counts once wherever the facets' rims are. Where the nodes of both surfaces are
  /// asked, each counts half. With R-trees: the time grows with the surfaces.
  template <int dim>
  std::vector<ContactTerm<dim>>
  find_contact_terms(const ContactSurfaces<dim>                  &surfaces,
                     const typename ContactSurfaces<dim>::Places &places,
                     double                                       gap);

  /// d^2 (distance) and the rest of what a potential b(distance) needs: adds
  /// slope d^2 distance + curvature (d distance) (d distance)^T, in N/m, node by node, to
  /// result[i][j], i and j < n.
  template <int dim>
  using NodeMatrices = std::array<std::array<dealii::Tensor<2, dim>, dim + 1>, dim + 1>;

  template <int dim>
  NodeMatrices<dim>
  second_derivatives(const ContactTerm<dim>                      &term,
                     const typename ContactSurfaces<dim>::Places &places,
                     double                                       slope,
                     double                                       curvature);
} // namespace undine

#endif
