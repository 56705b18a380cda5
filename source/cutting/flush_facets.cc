// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/cutting/flush_facets.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

namespace undine
{
  namespace
  {
    constexpr double largest_slope = 1e-2; ///< of a facet that lies along a plane

    /// A facet in a plane of the grid.
    template <int dim>
    struct FlushFacet
    {
      unsigned int       facet;
      dealii::Point<dim> lower, upper; ///< of the box around it
    };

    /// Those in one plane, by where the fluid is.
    template <int dim>
    struct FlushPlane
    {
      std::vector<FlushFacet<dim>> fluid_below, fluid_above;
    };


    template <int dim>
    class FlushFacets
    {
    public:
      FlushFacets(const GridPlanes<dim>                 &planes,
                  const Surface<dim>                    &surface,
                  const std::vector<dealii::Point<dim>> &positions)
        : planes(planes)
        , surface(surface)
        , positions(positions)
      {
        for (unsigned int facet = 0; facet < surface.facets().size(); ++facet)
          collect(facet);
      }

      std::vector<dealii::Point<dim>>
      moved() const
      {
        auto result = positions;
        for (const auto &[key, plane] : all)
          {
            const unsigned int axis   = std::get<0>(key);
            const int          number = std::get<1>(key);
            const auto         held   = nodes_of_facing(plane, axis);
            const double       place  = planes.position(axis, number);
            // A few units of what rounding may do to lengths there.
            const double beyond =
              4 * planes.rounding(axis, number - 1) * planes.width(axis, number - 1);
            const auto move = [&](const auto &facets, const auto &new_place) {
              for (const auto &flush : facets)
                for (const unsigned int node : surface.facets()[flush.facet])
                  if (!std::binary_search(held.begin(), held.end(), node))
                    result[node][axis] = new_place(positions[node][axis]);
            };
            move(plane.fluid_above, [&](const double x) { return std::max(x, place); });
            move(plane.fluid_below, [&](const double x) { return std::min(x, place - beyond); });
          }
        return result;
      }

    private:
      void
      collect(const unsigned int facet)
      {
        const auto &nodes  = surface.facets()[facet];
        const auto  normal = area_vector(surface, facet, positions);
        for (unsigned int axis = 0; axis < dim; ++axis)
          {
            const int plane = near_plane(axis, positions[nodes[0]][axis]);
            bool      along = plane > 0;
            for (unsigned int k = 1; k < dim && along; ++k)
              along = near_plane(axis, positions[nodes[k]][axis]) == plane;
            for (unsigned int d = 0; d < dim && along; ++d)
              along = d == axis || std::abs(normal[d]) <= largest_slope * std::abs(normal[axis]);
            if (!along || normal[axis] == 0)
              continue;
            FlushFacet<dim> flush{facet, positions[nodes[0]], positions[nodes[0]]};
            for (const unsigned int node : nodes)
              for (unsigned int d = 0; d < dim; ++d)
                {
                  flush.lower[d] = std::min(flush.lower[d], positions[node][d]);
                  flush.upper[d] = std::max(flush.upper[d], positions[node][d]);
                }
            auto &in_plane = all[{axis, plane}];
            (normal[axis] > 0 ? in_plane.fluid_above : in_plane.fluid_below).push_back(flush);
          }
      }

      /// The plane inside the grid within reach of a coordinate; 0: none.
      int
      near_plane(const unsigned int axis, const double x) const
      {
        const int slab = planes.slab(axis, x);
        for (const int plane : {slab, slab + 1})
          if (plane > 0 && plane < planes.n_cells(axis) &&
              std::abs(x - planes.position(axis, plane)) <=
                flush_reach * std::min(planes.width(axis, plane - 1), planes.width(axis, plane)))
            return plane;
        return 0;
      }

      /// Nodes of facets that others face with fluid between, not a thin body, ascending.
      std::vector<unsigned int>
      nodes_of_facing(const FlushPlane<dim> &plane, const unsigned int axis) const
      {
        std::vector<unsigned int> nodes;
        for (const auto &a : plane.fluid_below)
          for (const auto &b : plane.fluid_above)
            if (overlap(a, b, axis) &&
                a.lower[axis] + a.upper[axis] >= b.lower[axis] + b.upper[axis])
              for (const auto &flush : {a, b})
                nodes.insert(nodes.end(),
                             surface.facets()[flush.facet].begin(),
                             surface.facets()[flush.facet].end());
        std::sort(nodes.begin(), nodes.end());
        return nodes;
      }

      static bool
      overlap(const FlushFacet<dim> &a, const FlushFacet<dim> &b, const unsigned int axis)
      {
        bool result = true;
        for (unsigned int d = 0; d < dim; ++d)
          result = result && (d == axis || (a.lower[d] <= b.upper[d] && b.lower[d] <= a.upper[d]));
        return result;
      }

      const GridPlanes<dim>                                   &planes;
      const Surface<dim>                                      &surface;
      const std::vector<dealii::Point<dim>>                   &positions;
      std::map<std::tuple<unsigned int, int>, FlushPlane<dim>> all; ///< by axis and plane
    };


    /// Nodes that are as close to a side of the grid as rounding are put onto it: a body that ends
    /// there leaves no gap through which fluid on one side of it would be joined to the other.
    template <int dim>
    void
    put_onto_sides(std::vector<dealii::Point<dim>> &nodes, const GridPlanes<dim> &planes)
    {
      for (unsigned int axis = 0; axis < dim; ++axis)
        for (const int plane : {0, planes.n_cells(axis)})
          {
            const int    cell     = std::min(plane, planes.n_cells(axis) - 1);
            const double place    = planes.position(axis, plane);
            const double rounding = planes.rounding(axis, cell) * planes.width(axis, cell);
            for (auto &node : nodes)
              if (std::abs(node[axis] - place) <= rounding)
                node[axis] = place;
          }
    }
  } // namespace


  template <int dim>
  std::vector<dealii::Point<dim>>
  beyond_planes(const GridPlanes<dim>                 &planes,
                const Surface<dim>                    &surface,
                const std::vector<dealii::Point<dim>> &positions)
  {
    auto result = FlushFacets<dim>(planes, surface, positions).moved();
    put_onto_sides(result, planes);
    return result;
  }


  template std::vector<dealii::Point<2>>
  beyond_planes(const GridPlanes<2> &, const Surface<2> &, const std::vector<dealii::Point<2>> &);
  template std::vector<dealii::Point<3>>
  beyond_planes(const GridPlanes<3> &, const Surface<3> &, const std::vector<dealii::Point<3>> &);
} // namespace undine
