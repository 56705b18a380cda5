// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/surface/simplex.h>
#include <undine/surface/surface_crossings.h>

#include <deal.II/base/bounding_box.h>

#include <algorithm>
#include <cmath>

namespace undine
{
  namespace
  {
    /// The edges of a facet. @{
    std::array<std::array<unsigned int, 2>, 1>
    edges(const std::array<unsigned int, 2> &facet)
    {
      return {{{{std::min(facet[0], facet[1]), std::max(facet[0], facet[1])}}}};
    }

    std::array<std::array<unsigned int, 2>, 3>
    edges(const std::array<unsigned int, 3> &facet)
    {
      return {{ridge(facet, 0), ridge(facet, 1), ridge(facet, 2)}};
    }
    /// @}


    template <int dim>
    class CrossingFinder
    {
    public:
      using Facet = typename Surface<dim>::Facet;
      using Edge  = std::array<unsigned int, 2>;
      using Box   = std::array<dealii::Point<dim>, 2>; ///< lower and upper corner

      CrossingFinder(const Surface<dim>                    &surface,
                     const std::vector<dealii::Point<dim>> &positions,
                     const double                           uncertainty)
        : surface(surface)
        , positions(positions)
        , uncertainty(uncertainty)
      {
      }

      void
      find(const PairOfSurfaces &pair)
      {
        const auto of_first = facets_in(pair[0], box_of(pair[1])),
                   of_other = facets_in(pair[1], box_of(pair[0]));
        for (const unsigned int a : of_first)
          for (const unsigned int b : of_other)
            if (meet(box_of_facet(a), box_of_facet(b)))
              cross(a, b);
      }

      SurfaceCrossings<dim> result;

    private:
      Box
      box_of_facet(const unsigned int facet) const
      {
        const auto &nodes = surface.facets()[facet];
        Box         box{{positions[nodes[0]], positions[nodes[0]]}};
        for (const unsigned int node : nodes)
          include(box, positions[node], positions[node]);
        return box;
      }

      Box
      box_of(const unsigned int body) const
      {
        Box  result;
        bool is_first = true;
        for (unsigned int facet = 0; facet < surface.facets().size(); ++facet)
          if (surface.body(facet) == body)
            {
              const auto box = box_of_facet(facet);
              if (is_first)
                result = box;
              include(result, box[0], box[1]);
              is_first = false;
            }
        return result;
      }

      static void
      include(Box &box, const dealii::Point<dim> &lower, const dealii::Point<dim> &upper)
      {
        for (unsigned int d = 0; d < dim; ++d)
          {
            box[0][d] = std::min(box[0][d], lower[d]);
            box[1][d] = std::max(box[1][d], upper[d]);
          }
      }

      static bool
      meet(const Box &a, const Box &b)
      {
        bool result = true;
        for (unsigned int d = 0; d < dim; ++d)
          result = result && a[0][d] <= b[1][d] && b[0][d] <= a[1][d];
        return result;
      }

      std::vector<unsigned int>
      facets_in(const unsigned int body, const Box &box) const
      {
        std::vector<unsigned int> result;
        for (unsigned int facet = 0; facet < surface.facets().size(); ++facet)
          if (surface.body(facet) == body && meet(box_of_facet(facet), box))
            result.push_back(facet);
        return result;
      }

      /// dim! times the volume of the simplex of these nodes, with its sign [m^dim].
      double
      volume(const std::array<unsigned int, dim + 1> &nodes)
      {
        auto sorted = nodes;
        bool is_odd = false;
        for (unsigned int i = 0; i < dim; ++i) // each exchange changes the sign
          for (unsigned int k = 0; k < dim - i; ++k)
            if (sorted[k] > sorted[k + 1])
              {
                std::swap(sorted[k], sorted[k + 1]);
                is_odd = !is_odd;
              }
        dealii::Tensor<2, dim> sides;
        for (unsigned int k = 0; k < dim; ++k)
          sides[k] = positions[sorted[k + 1]] - positions[sorted[0]];
        const double volume = dealii::determinant(sides);
        double       box    = 1;
        for (unsigned int k = 0; k < dim; ++k)
          box *= sides[k].norm();
        if (std::abs(volume) < uncertainty * box)
          result.are_sure = false;
        return is_odd ? -volume : volume;
      }

      /// Of an edge and a facet without one of its nodes, the sign alternating with the latter, so
      /// that all have one sign if the edge's line passes through the facet.
      double
      volume_beside(const Edge &edge, const Facet &facet, const unsigned int without)
      {
        std::array<unsigned int, dim + 1> nodes{{edge[0], edge[1]}};
        unsigned int                      n = 2;
        for (unsigned int k = 0; k < dim; ++k)
          if (k != without)
            nodes[n++] = facet[k];
        return without % 2 == 0 ? volume(nodes) : -volume(nodes);
      }

      double
      volume_above(const Facet &facet, const unsigned int node)
      {
        std::array<unsigned int, dim + 1> nodes;
        std::copy(facet.begin(), facet.end(), nodes.begin());
        nodes[dim] = node;
        return volume(nodes);
      }

      /// The number of the node in which an edge passes through a facet; -1: it does not.
      int
      piercing(const Edge &edge, const unsigned int facet)
      {
        const auto                       &nodes = surface.facets()[facet];
        std::array<unsigned int, dim + 2> key{{edge[0], edge[1]}};
        std::copy(nodes.begin(), nodes.end(), key.begin() + 2);
        std::sort(key.begin(), key.end());
        const auto known = found.find(key);
        if (known != found.end())
          return known->second;
        return found[key] = make_piercing(edge, nodes);
      }

      int
      make_piercing(const Edge &edge, const Facet &facet)
      {
        const std::array<double, 2> heights{
          {volume_above(facet, edge[0]), volume_above(facet, edge[1])}};
        if ((heights[0] < 0) == (heights[1] < 0))
          return -1;
        Piercing piercing{edge, heights[0] / (heights[0] - heights[1]), facet, {}};
        double   sum = 0;
        for (unsigned int k = 0; k < dim; ++k)
          {
            piercing.weights[k] = volume_beside(edge, facet, k);
            if ((piercing.weights[k] < 0) != (piercing.weights[0] < 0))
              return -1;
            sum += piercing.weights[k];
          }
        for (double &weight : piercing.weights)
          weight = sum != 0 ? weight / sum : 1. / dim;
        result.new_nodes.push_back({edge, piercing.part});
        all.push_back(piercing);
        return positions.size() + all.size() - 1;
      }

      /// A line along which two facets cross goes from one piercing to another.
      void
      cross(const unsigned int a, const unsigned int b)
      {
        std::set<unsigned int> hits;
        const auto             pierce = [&](const unsigned int of, const unsigned int through) {
          for (const auto &edge : edges(surface.facets()[of]))
            if (const int node = piercing(edge, through); node >= 0)
              hits.insert(node);
        };
        pierce(a, b);
        pierce(b, a);
        if (hits.empty())
          return;
        if (hits.size() != dim - 1)
          {
            result.are_sure = false;
            return;
          }
        typename Surface<dim>::Ridge line;
        std::copy(hits.begin(), hits.end(), line.begin());
        for (const unsigned int facet : {a, b})
          {
            auto &inside = result.in_facets[facet];
            inside.lines.insert(line);
            for (const unsigned int node : hits)
              inside.nodes[node] = weights_in(facet, all[node - positions.size()]);
          }
      }

      struct Piercing
      {
        Edge                    edge;
        double                  part; ///< of the edge, up to there
        Facet                   facet;
        std::array<double, dim> weights; ///< in the facet
      };

      std::array<double, dim>
      weights_in(const unsigned int facet, const Piercing &piercing) const
      {
        const auto             &nodes = surface.facets()[facet];
        std::array<double, dim> result{};
        const auto              first = std::find(nodes.begin(), nodes.end(), piercing.edge[0]);
        const auto              last  = std::find(nodes.begin(), nodes.end(), piercing.edge[1]);
        if (first == nodes.end() || last == nodes.end())
          return piercing.weights;
        result[first - nodes.begin()] = 1 - piercing.part;
        result[last - nodes.begin()]  = piercing.part;
        return result;
      }

      const Surface<dim>                    &surface;
      const std::vector<dealii::Point<dim>> &positions;
      const double uncertainty; ///< of volumes, over the product of edges [1]
      std::map<std::array<unsigned int, dim + 2>, int> found; ///< by all nodes, ascending
      std::vector<Piercing>                            all;   ///< of the new nodes
    };
  } // namespace


  template <int dim>
  SurfaceCrossings<dim>
  find_crossings(const Surface<dim>                    &surface,
                 const std::vector<dealii::Point<dim>> &positions,
                 const std::vector<PairOfSurfaces>     &pairs,
                 const double                           uncertainty)
  {
    CrossingFinder<dim> finder(surface, positions, uncertainty);
    for (const auto &pair : pairs)
      finder.find(pair);
    return finder.result;
  }


#define UNDINE_INSTANTIATE(dim)                                                          \
  template struct SurfaceCrossings<dim>;                                                 \
  template SurfaceCrossings<dim> find_crossings(const Surface<dim> &,                    \
                                                const std::vector<dealii::Point<dim>> &, \
                                                const std::vector<PairOfSurfaces> &,     \
                                                double);

  UNDINE_INSTANTIATE(2)
  UNDINE_INSTANTIATE(3)
#undef UNDINE_INSTANTIATE
} // namespace undine
