// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/contact/contact_boxes.h>
#include <undine/contact/contact_terms.h>
#include <undine/surface/nearest_of_edges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <set>

namespace undine
{
  namespace
  {
    template <int dim>
    using Positions = typename ContactSurfaces<dim>::Positions;


    template <int dim>
    void
    add_walls(std::vector<ContactTerm<dim>>  &terms,
              const ContactSurfaces<dim>     &surfaces,
              const ActivationDistances<dim> &distances,
              const Positions<dim>           &places)
    {
      for (unsigned int node = 0; node < surfaces.bodies().n_nodes(); ++node)
        for (unsigned int wall = 0; wall < surfaces.walls().size(); ++wall)
          {
            const auto  &plane               = surfaces.walls()[wall];
            const double distance            = (places[node] - plane.point) * plane.normal;
            const double activation_distance = distances.of_wall(node, wall);
            if (distance >= activation_distance || !surfaces.meets_wall(node, wall))
              continue;
            ContactTerm<dim> term;
            term.nodes[0]            = node;
            term.shares[0]           = 1;
            term.direction           = plane.normal;
            term.distance            = distance;
            term.area                = surfaces.area(node);
            term.wall                = wall;
            term.activation_distance = activation_distance;
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
    places_of(const Simplex<dim> &simplex, const Positions<dim> &places)
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
             const Positions<dim>          &places,
             const double                   area,
             const double                   activation_distance)
    {
      std::map<Simplex<dim>, Count<dim>> counts;
      for (const auto &part : parts)
        {
          const auto nearest = nearest_in_simplex<dim>(part, places_of(part, places), places[node]);
          if (nearest.distance >= activation_distance)
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
              if (k > 0)
                term.edge_vectors[term.n_edge_vectors++] = {1, k + 1, -1};
            }
          term.distance = nearest.distance;
          if (nearest.distance > 0)
            term.direction = nearest.from / nearest.distance;
          term.area                = entry.second.times * area;
          term.activation_distance = activation_distance;
          terms.push_back(term);
        }
    }


    /// The squared sine of the angle from which on two edges count in full (S17): 1.8 degrees, or a
    /// right angle if one is blunt. Meshes of smooth surfaces have many edges that are nearly
    /// parallel: their forces must not change much with that angle.
    double
    least_crossing(const SharpEdge &one, const SharpEdge &other)
    {
      return one.blunt || other.blunt ? 1 : 1e-3;
    }


    template <int dim>
    void
    add_edges(std::vector<ContactTerm<dim>> &terms,
              const SharpEdge               &one,
              const SharpEdge               &other,
              const Positions<dim>          &places,
              const double                   activation_distance)
    {
      const std::array<unsigned int, 4> nodes{
        {one.nodes[0], one.nodes[1], other.nodes[0], other.nodes[1]}};
      std::array<dealii::Point<dim>, 4> x;
      for (unsigned int i = 0; i < 4; ++i)
        x[i] = places[nodes[i]];
      const auto nearest = nearest_of_edges<dim>(x);
      if (nearest.distance >= activation_distance)
        return;
      ContactTerm<dim> term;
      term.n = 4;
      for (unsigned int edge = 0; edge < 2; ++edge)
        {
          const unsigned int first  = 2 * edge;
          const int          sign   = edge == 0 ? 1 : -1;
          term.nodes.at(first)      = nodes[first];
          term.nodes.at(first + 1)  = nodes[first + 1];
          term.shares.at(first)     = sign * (1 - nearest.parts[edge]);
          term.shares.at(first + 1) = sign * nearest.parts[edge];
          if (nearest.inside[edge])
            term.edge_vectors[term.n_edge_vectors++] = {first, first + 1, sign};
        }
      term.distance = nearest.distance;
      if (nearest.distance > 0)
        term.direction = nearest.from / nearest.distance;
      term.area                = std::min(one.area, other.area);
      term.activation_distance = activation_distance;
      term.crossing = least_crossing(one, other) * std::pow(one.length * other.length, 2);
      terms.push_back(term);
    }


    /// Facets, and of their ridges and corners those that belong to no facet that is left out: what
    /// only one facet has counts once with that.
    template <int dim>
    std::set<Simplex<dim>>
    without_rims(const std::set<Simplex<dim>> &parts, const std::set<Simplex<dim>> &left_out)
    {
      std::set<Simplex<dim>> result;
      std::set_difference(parts.begin(),
                          parts.end(),
                          left_out.begin(),
                          left_out.end(),
                          std::inserter(result, result.end()));
      return result;
    }


    template <int dim>
    void
    add_different_surfaces(std::vector<ContactTerm<dim>>  &terms,
                           const ContactSurfaces<dim>     &surfaces,
                           const ActivationDistances<dim> &distances,
                           const Positions<dim>           &places)
    {
      const double                                   distance = distances.of_others();
      std::map<unsigned int, std::set<Simplex<dim>>> parts; // by surface, of one node
      unsigned int                                   last        = 0;
      const auto                                     finish_node = [&] {
        for (const auto &of_surface : parts)
          add_node<dim>(terms, of_surface.second, last, places, surfaces.area(last) / 2, distance);
        parts.clear();
      };
      for_each_near_pair(
        surfaces, places, places, distance, [&](const unsigned int node, const unsigned int facet) {
          if (node != last)
            finish_node();
          last = node;
          add_parts<dim>(parts[surfaces.surface().body(facet)], surfaces.surface().facets()[facet]);
        });
      finish_node();
      const auto &edges = surfaces.sharp_edges();
      for_each_near_edges<dim>(
        surfaces, places, places, distance, [&](const unsigned int one, const unsigned int other) {
          add_edges(terms, edges[one], edges[other], places, distance);
        });
    }


    template <int dim>
    void
    add_own_surfaces(std::vector<ContactTerm<dim>>  &terms,
                     const ContactSurfaces<dim>     &surfaces,
                     const ActivationDistances<dim> &distances,
                     const OwnPairsNearby           &nearby,
                     const Positions<dim>           &places)
    {
      const auto &facets   = surfaces.surface().facets();
      auto        left_out = nearby.left_out.begin();
      for (auto pair = nearby.facets.begin(); pair != nearby.facets.end();)
        {
          const unsigned int     node = pair->first;
          std::set<Simplex<dim>> parts, others;
          for (; pair != nearby.facets.end() && pair->first == node; ++pair)
            add_parts<dim>(parts, facets[pair->second]);
          for (; left_out != nearby.left_out.end() && left_out->first == node; ++left_out)
            add_parts<dim>(others, facets[left_out->second]);
          add_node<dim>(terms,
                        without_rims(parts, others),
                        node,
                        places,
                        surfaces.area(node) / 2,
                        distances.of_own(node));
        }
      const auto &edges = surfaces.sharp_edges();
      for (const auto &pair : nearby.edges)
        add_edges(terms,
                  edges[pair.first],
                  edges[pair.second],
                  places,
                  distances.of_own_edges(pair.first, pair.second));
    }
  } // namespace


  template <int dim>
  std::vector<ContactTerm<dim>>
  find_contact_terms(const ContactSurfaces<dim>     &surfaces,
                     const ActivationDistances<dim> &distances,
                     const OwnPairsNearby           &nearby,
                     const Positions<dim>           &places)
  {
    std::vector<ContactTerm<dim>> terms;
    add_walls(terms, surfaces, distances, places);
    add_different_surfaces(terms, surfaces, distances, places);
    add_own_surfaces(terms, surfaces, distances, nearby, places);
    return terms;
  }


  template std::vector<ContactTerm<2>>
  find_contact_terms(const ContactSurfaces<2> &,
                     const ActivationDistances<2> &,
                     const OwnPairsNearby &,
                     const std::vector<dealii::Point<2>> &);
  template std::vector<ContactTerm<3>>
  find_contact_terms(const ContactSurfaces<3> &,
                     const ActivationDistances<3> &,
                     const OwnPairsNearby &,
                     const std::vector<dealii::Point<3>> &);
} // namespace undine
