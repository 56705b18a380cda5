// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_contact_contact_terms_h
#define undine_contact_contact_terms_h

#include <undine/contact/activation_distances.h>
#include <undine/contact/contact_surfaces.h>
#include <undine/contact/own_pairs.h>
#include <undine/surface/nearest_in_simplex.h>

#include <array>
#include <vector>

namespace undine
{
  /// A node near a simplex of another surface, of another part of its own, or near a wall; or two
  /// sharp edges near each other.
  template <int dim>
  struct ContactTerm
  {
    static constexpr unsigned int no_wall = -1;

    /// A difference vector between two nodes along which a nearest point slides when nodes move.
    struct EdgeVector
    {
      unsigned int from, to; ///< positions in `nodes`
      int          sign;     ///< 1 on the side of the first nearest point, -1 on that of the second
    };

    unsigned int n = 1;                         ///< nodes: the node, then those of the simplex;
                                                ///< or those of one edge, then of the other
    std::array<unsigned int, dim + 1> nodes{};  ///< n of them are used
    std::array<double, dim + 1>       shares{}; ///< of nodes in the nearest points, the second's
                                                ///< negative: the sum of all is 0
    unsigned int                    n_edge_vectors = 0;
    std::array<EdgeVector, dim - 1> edge_vectors; ///< n_edge_vectors of them are used
    dealii::Tensor<1, dim>          direction;    ///< from the second nearest point to the first
    double                          distance = 0; ///< [m]
    double                          area     = 0; ///< on which it acts, negative if it is taken
                                                  ///< off what others count twice [m^(dim-1)]
    double       activation_distance = 0;         ///< D of this term [m]
    double       crossing            = 0;         ///< of edges: e in (S17) [m^4]; 0: no edges
    unsigned int wall                = no_wall;
  };

  /// All terms with a distance below that of their activation, in an order that depends on `places`
  /// only: for every node those with all facets, minus those with ridges, plus those with corners
  /// (in 2D facets minus ends), so that a flat or convex surface counts once wherever the rims of
  /// facets are. Where the nodes of both surfaces have terms, each counts half. Then pairs of sharp
  /// edges; first those of different surfaces, then those of one with itself, which must be among
  /// those `nearby`. R-trees make the time
  /// proportional to the size of the surfaces. Not collective.
  template <int dim>
  std::vector<ContactTerm<dim>>
  find_contact_terms(const ContactSurfaces<dim>                     &surfaces,
                     const ActivationDistances<dim>                 &distances,
                     const OwnPairsNearby                           &nearby,
                     const typename ContactSurfaces<dim>::Positions &places);
} // namespace undine

#endif
