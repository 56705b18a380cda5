// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/interface/contact_boxes.h>
#include <undine/interface/contact_terms.h>

#include <deal.II/base/symmetric_tensor.h>

#include <algorithm>
#include <map>
#include <set>

namespace undine
{
  namespace
  {
    template <int dim>
    using Places = typename ContactSurfaces<dim>::Places;


    template <int dim>
    void
    add_walls(std::vector<ContactTerm<dim>> &terms,
              const ContactSurfaces<dim>    &surfaces,
              const Places<dim>             &places,
              const double                   gap)
    {
      for (unsigned int node = 0; node < surfaces.bodies().n_nodes(); ++node)
        for (unsigned int wall = 0; wall < surfaces.walls().size(); ++wall)
          {
            const auto  &plane    = surfaces.walls()[wall];
            const double distance = (places[node] - plane.point) * plane.normal;
            if (distance >= gap || surfaces.is_held_at(surfaces.surface_of_node(node), wall))
              continue;
            ContactTerm<dim> term;
            term.nodes[0]  = node;
            term.shares[0] = 1;
            term.direction = plane.normal;
            term.distance  = distance;
            term.area      = surfaces.area(node);
            term.wall      = wall;
            terms.push_back(term);
          }
    }


    /// The facet with its ridges and corners.
    template <int dim>
    void
    add_parts(std::set<Simplex<dim>> &parts, typename Surface<dim>::Facet facet)
    {
      std::sort(facet.begin(), facet.end());
      for (unsigned int choice = 1; choice < (1u << dim); ++choice)
        {
          Simplex<dim> part;
          for (unsigned int k = 0; k < dim; ++k)
            if (choice & (1u << k))
              part.nodes[part.n++] = facet[k];
          parts.insert(part);
        }
    }


    template <int dim>
    std::array<dealii::Point<dim>, dim>
    places_of(const Simplex<dim> &simplex, const Places<dim> &places)
    {
      std::array<dealii::Point<dim>, dim> result;
      for (unsigned int k = 0; k < simplex.n; ++k)
        result[k] = places[simplex.nodes[k]];
      return result;
    }


    /// How often the inside of a simplex is what is nearest.
    template <int dim>
    struct Count
    {
      int                   times = 0;
      NearestInSimplex<dim> nearest;
    };


    /// The terms of one node with parts of one surface.
    template <int dim>
    void
    add_node(std::vector<ContactTerm<dim>> &terms,
             const std::set<Simplex<dim>>  &parts,
             const unsigned int             node,
             const Places<dim>             &places,
             const double                   area,
             const double                   gap)
    {
      std::map<Simplex<dim>, Count<dim>> counts;
      for (const auto &part : parts)
        {
          const auto nearest = nearest_in_simplex<dim>(part, places_of(part, places), places[node]);
          if (nearest.distance >= gap)
            continue;
          auto &count   = counts[nearest.inside];
          count.nearest = nearest;
          count.times += (dim - part.n) % 2 == 0 ? 1 : -1;
        }
      for (const auto &entry : counts)
        {
          const auto &nearest = entry.second.nearest;
          if (entry.second.times == 0)
            continue;
          ContactTerm<dim> term;
          term.n         = 1 + nearest.inside.n;
          term.nodes[0]  = node;
          term.shares[0] = 1;
          for (unsigned int k = 0; k < nearest.inside.n; ++k)
            {
              term.nodes[k + 1]  = nearest.inside.nodes[k];
              term.shares[k + 1] = -nearest.weights[k];
            }
          term.distance = nearest.distance;
          if (nearest.distance > 0)
            term.direction = nearest.from / nearest.distance;
          term.area = entry.second.times * area;
          terms.push_back(term);
        }
    }
  } // namespace


  template <int dim>
  std::vector<ContactTerm<dim>>
  find_contact_terms(const ContactSurfaces<dim> &surfaces,
                     const Places<dim>          &places,
                     const double                gap)
  {
    std::vector<ContactTerm<dim>> terms;
    add_walls(terms, surfaces, places, gap);
    std::map<unsigned int, std::set<Simplex<dim>>> parts; // by surface, of one node
    unsigned int                                   last        = 0;
    const auto                                     finish_node = [&] {
      for (const auto &of_surface : parts)
        add_node<dim>(terms, of_surface.second, last, places, surfaces.area(last) / 2, gap);
      parts.clear();
    };
    for_each_near_pair(
      surfaces, places, places, gap, [&](const unsigned int node, const unsigned int facet) {
        if (node != last)
          finish_node();
        last = node;
        add_parts<dim>(parts[surfaces.surface().body(facet)], surfaces.surface().facets()[facet]);
      });
    finish_node();
    return terms;
  }


  template <int dim>
  NodeMatrices<dim>
  second_derivatives(const ContactTerm<dim> &term,
                     const Places<dim>      &places,
                     const double            slope,
                     const double            curvature)
  {
    NodeMatrices<dim> result;
    const auto        normal  = outer_product(term.direction, term.direction);
    const double      turning = term.wall == ContactTerm<dim>::no_wall ? slope / term.distance : 0;
    const auto        unit    = dealii::unit_symmetric_tensor<dim>();

    // The nearest point moves along the ways T_a from the simplex's first node to the others.
    std::array<dealii::Point<dim>, dim> corners;
    for (unsigned int k = 1; k < term.n; ++k)
      corners[k - 1] = places[term.nodes[k]];
    const unsigned int n_ways  = term.n < 2 ? 0 : term.n - 2;
    const auto         inverse = inverse_of_products<dim>(n_ways + 1, corners);
    std::array<std::array<dealii::Tensor<1, dim>, dim + 1>, dim> mixed; // [a][node]
    for (unsigned int a = 0; a < n_ways; ++a)
      for (unsigned int i = 0; i < term.n; ++i)
        {
          const int turn = i == 1 ? 1 : i == a + 2 ? -1 : 0;
          mixed[a][i]    = (turn * term.distance) * term.direction -
                        term.shares[i] * (corners[a + 1] - corners[0]);
        }
    for (unsigned int i = 0; i < term.n; ++i)
      for (unsigned int j = 0; j < term.n; ++j)
        {
          const double shares = term.shares[i] * term.shares[j];
          result[i][j]        = (shares * turning) * dealii::Tensor<2, dim>(unit);
          result[i][j] += (shares * (curvature - turning)) * normal;
          for (unsigned int a = 0; a < n_ways; ++a)
            for (unsigned int b = 0; b < n_ways; ++b)
              result[i][j] -= (turning * inverse[a][b]) * outer_product(mixed[a][i], mixed[b][j]);
        }
    return result;
  }


#define UNDINE_INSTANTIATE(dim)                                                     \
  template std::vector<ContactTerm<dim>> find_contact_terms(                        \
    const ContactSurfaces<dim> &, const std::vector<dealii::Point<dim>> &, double); \
  template NodeMatrices<dim> second_derivatives(                                    \
    const ContactTerm<dim> &, const std::vector<dealii::Point<dim>> &, double, double);

  UNDINE_INSTANTIATE(2)
  UNDINE_INSTANTIATE(3)
#undef UNDINE_INSTANTIATE
} // namespace undine
