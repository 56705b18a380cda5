// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/operators/enclosed_volume.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace undine
{
  namespace
  {
    /// The share that a fragment has of its facet where the grid was cut, and keeps [1].
    template <int dim>
    double
    share_when_cut(const typename CutCells<dim>::Fragment &fragment,
                   const Surface<dim>                     &surface,
                   const std::vector<dealii::Point<dim>>  &cut_at)
    {
      const double whole = area_vector(surface, fragment.facet, cut_at).norm();
      return whole > 0 ? fragment.area_vector.norm() / whole : 0.;
    }


    /// Of the part of a facet inside the domain.
    struct Inside
    {
      double share  = 0; ///< its area
      double moment = 0; ///< the integral of x_a - c [m], both over the area of the whole facet
    };


    template <int dim>
    class PartInside
    {
    public:
      using Simplex = std::array<dealii::Point<dim>, dim>;

      PartInside(const MacGrid<dim> &grid, const unsigned int axis, const double c)
        : grid(grid)
        , axis(axis)
        , c(c)
      {
      }

      Inside
      operator()(const Surface<dim>                    &surface,
                 const unsigned int                     facet,
                 const std::vector<dealii::Point<dim>> &positions) const
      {
        Simplex corners;
        for (unsigned int k = 0; k < dim; ++k)
          corners[k] = positions[surface.facets()[facet][k]];
        Inside result;
        add(result, corners, 1, 0);
        return result;
      }

    private:
      /// A part that is `share` of the facet and does not reach beyond the first `n_clipped` sides.
      void
      add(Inside            &result,
          const Simplex     &part,
          const double       share,
          const unsigned int n_clipped) const
      {
        if (n_clipped == 2 * dim)
          {
            double mean = 0;
            for (const auto &corner : part)
              mean += corner[axis] / dim;
            result.share += share;
            result.moment += share * (mean - c);
            return;
          }
        unsigned int least = 0, most = 0;
        for (unsigned int k = 1; k < dim; ++k)
          {
            least = depth(part[k], n_clipped) < depth(part[least], n_clipped) ? k : least;
            most  = depth(part[k], n_clipped) > depth(part[most], n_clipped) ? k : most;
          }
        const double below = depth(part[least], n_clipped), above = depth(part[most], n_clipped);
        if (above <= 0)
          return;
        if (below >= 0)
          {
            add(result, part, share, n_clipped + 1);
            return;
          }
        // Where the edge between these corners passes the side the part is divided.
        const double t     = below / (below - above);
        auto         place = part[least] + t * (part[most] - part[least]);
        place[n_clipped / 2] =
          n_clipped % 2 == 0 ? grid.lower()[n_clipped / 2] : grid.upper()[n_clipped / 2];
        auto inner = part, outer = part;
        inner[least] = place;
        outer[most]  = place;
        add(result, inner, share * (1 - t), n_clipped);
        add(result, outer, share * t, n_clipped);
      }

      /// How far a place is within a side [m].
      double
      depth(const dealii::Point<dim> &place, const unsigned int side) const
      {
        const unsigned int d = side / 2;
        return side % 2 == 0 ? place[d] - grid.lower()[d] : grid.upper()[d] - place[d];
      }

      const MacGrid<dim> &grid;
      const unsigned int  axis;
      const double        c;
    };


    /// Does the side of the domain bound the region?
    template <int dim>
    bool
    bounds(const RegionBoundary<dim> &boundary, const unsigned int axis, const unsigned int end)
    {
      return boundary.side_areas[2 * axis + end] > 0;
    }


    /// One along which the region does not reach from side to side, if there is one.
    template <int dim>
    unsigned int
    best_axis(const MacGrid<dim> &grid, const RegionBoundary<dim> &boundary)
    {
      unsigned int best = dim;
      for (unsigned int axis = dim; axis-- > 0;)
        if (!grid.periodic(axis) &&
            (best == dim || !bounds(boundary, axis, 0) || !bounds(boundary, axis, 1)))
          best = axis;
      AssertIndexRange(best, dim);
      return best;
    }
  } // namespace


  template <int dim>
  double
  enclosed_volume(const MacGrid<dim>                    &grid,
                  const CutCells<dim>                   &cut,
                  const Surface<dim>                    &surface,
                  const std::vector<dealii::Point<dim>> &cut_at,
                  const std::vector<dealii::Point<dim>> &positions,
                  const RegionBoundary<dim>             &boundary)
  {
    const unsigned int axis     = best_axis(grid, boundary);
    const bool         at_lower = bounds(boundary, axis, 0) || !bounds(boundary, axis, 1);
    const double       c        = at_lower ? grid.lower()[axis] : grid.upper()[axis];
    const std::size_t  n_facets = surface.facets().size();

    // Of each facet: what of it bounds the region, and the moment of that.
    std::vector<double> sums(2 * n_facets, 0.);
    for (int cell = 0; cell < static_cast<int>(cut.cells.size()); ++cell)
      for (int f = cut.cells[cell].first_fragment; f < cut.end_fragment(cell); ++f)
        if (const auto &fragment = cut.fragments[f];
            cut.block.owned().contains(cut.cells[cell].index) &&
            fragment.component != cut.no_component && boundary.has_component[fragment.component])
          {
            const double share = share_when_cut(fragment, surface, cut_at);
            double       mean  = 0;
            for (unsigned int k = 0; k < dim; ++k)
              mean += fragment.mean[k] * positions[surface.facets()[fragment.facet][k]][axis];
            sums[fragment.facet] += share;
            sums[n_facets + fragment.facet] += share * (mean - c);
          }
    dealii::Utilities::MPI::sum(sums, grid.communicator(), sums);

    constexpr double      rounding = 1e-9; // of shares; smaller fragments may have been dropped
    const PartInside<dim> part_inside(grid, axis, c);
    double                volume = boundary.side_areas[2 * axis + 1] * (grid.upper()[axis] - c);
    for (std::size_t facet = 0; facet < n_facets; ++facet)
      if (sums[facet] > 0)
        {
          const bool is_all = part_inside(surface, facet, cut_at).share - sums[facet] <= rounding;
          volume -=
            area_vector(surface, facet, positions)[axis] *
            (is_all ? part_inside(surface, facet, positions).moment : sums[n_facets + facet]);
        }
    return volume;
  }


#define UNDINE_INSTANTIATE(dim)                                            \
  template struct RegionBoundary<dim>;                                     \
  template double enclosed_volume(const MacGrid<dim> &,                    \
                                  const CutCells<dim> &,                   \
                                  const Surface<dim> &,                    \
                                  const std::vector<dealii::Point<dim>> &, \
                                  const std::vector<dealii::Point<dim>> &, \
                                  const RegionBoundary<dim> &);

  UNDINE_INSTANTIATE(2)
  UNDINE_INSTANTIATE(3)
#undef UNDINE_INSTANTIATE
} // namespace undine
