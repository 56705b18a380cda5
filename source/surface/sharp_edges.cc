// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/surface/sharp_edges.h>

#include <cmath>

namespace undine
{
  namespace
  {
    /// Cosines of 30 degrees and of one.
    constexpr double cosine_of_sharp = 0.8660254037844387;
    constexpr double cosine_of_flat  = 0.9998476951563913;


    double
    share_of_area(const double cosine)
    {
      return cosine < cosine_of_sharp ? 1 : (1 - cosine) / (1 - cosine_of_sharp);
    }


    dealii::Point<3>
    middle(const std::array<unsigned int, 3> &facet, const std::vector<dealii::Point<3>> &places)
    {
      return dealii::Point<3>((places[facet[0]] + places[facet[1]] + places[facet[2]]) / 3);
    }
  } // namespace


  std::vector<SharpEdge>
  find_sharp_edges(const Surface<2> &, const std::vector<dealii::Point<2>> &)
  {
    return {};
  }


  std::vector<SharpEdge>
  find_sharp_edges(const Surface<3> &surface, const std::vector<dealii::Point<3>> &places)
  {
    std::vector<std::vector<unsigned int>> facets(surface.ridges().size());
    for (unsigned int facet = 0; facet < surface.facets().size(); ++facet)
      for (const unsigned int ridge : surface.ridges(facet))
        facets[ridge].push_back(facet);
    std::vector<SharpEdge> result;
    for (unsigned int ridge = 0; ridge < facets.size(); ++ridge)
      {
        if (facets[ridge].size() != 2)
          continue;
        const auto  a       = area_vector(surface, facets[ridge][0], places);
        const auto  b       = area_vector(surface, facets[ridge][1], places);
        const auto &nodes   = surface.ridges()[ridge];
        const auto  segment = middle(surface.facets()[facets[ridge][1]], places) - places[nodes[0]];
        const bool  convex  = segment * a < 0;
        const auto  outwards = a / a.norm() + b / b.norm();
        const double cosine  = a * b / (a.norm() * b.norm());
        if (convex && cosine < cosine_of_flat)
          result.push_back({nodes,
                            surface.body(facets[ridge][0]),
                            places[nodes[0]].distance(places[nodes[1]]),
                            share_of_area(cosine) * ((a.norm() + b.norm()) / 3),
                            outwards / outwards.norm(),
                            cosine >= cosine_of_sharp});
      }
    return result;
  }
} // namespace undine
