// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/operators/flow_past_edges.h>
#include <undine/operators/wall_meetings.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

namespace undine
{
  namespace
  {
    /// Fluid flows past an edge in what is free of a piece and in so much of what lies in front of
    /// the wall as this times the distance of the wall: a stream widens behind an edge. That with
    /// which the tip of an elastic flag in a slow stream depends least on where planes lie.
    constexpr double widening = 0.5;

    /// What is free of the piece needs to be this times as wide as the wall is away, or the flow
    /// spreads over all of the piece. (With half of that forces have a peak where it is half as
    /// wide.)
    constexpr double room = 0.75;

    /// Walls whose normals have less than the first cosine with that of the piece do not hold fluid
    /// back in front of it, those that have at least the second do so all over.
    constexpr double least_facing = 0.85, most_facing = 0.95;

    /// The velocity past an edge is at most so many times that of the piece.
    constexpr double most_factor = 100;

    /// Shares of a piece below this are rounding.
    constexpr double negligible = 1e-9;

    /// Barycentric coordinates beyond edges reach so far, and to twice that less and less.
    constexpr double reach = 2;


    /// The walls in front of a piece, of one body.
    template <int dim>
    struct WallInFront
    {
      double                 size   = 0; ///< [m^(dim-1)]
      double                 area   = 0; ///< projected onto the plane [m^(dim-1)]
      double                 volume = 0; ///< between it and the plane [m^dim]
      dealii::Tensor<1, dim> moment;     ///< area times centroid [m^dim]

      std::array<unsigned int, dim + 1> simplex{}; ///< nodes of a facet, and one beyond its edge
      bool                              has_edge = false;
    };


    template <int dim>
    class PiecesAtEdges
    {
    public:
      PiecesAtEdges(const MacGrid<dim>       &grid,
                    const CutCells<dim>      &cut,
                    const CutTopology<dim>   &parts,
                    const PlacedSurface<dim> &placed,
                    const unsigned int        axis)
        : grid(grid)
        , cut(cut)
        , parts(parts)
        , open(*parts.open)
        , placed(placed)
        , axis(axis)
      {
      }

      /// What flows past an edge in the cell on one side, below (0) or above (1), of a piece of
      /// `face`, which may be an image beyond a periodic side.
      FlowPastEdge<dim>
      beside(const GridIndex<dim> &face, const int piece, const unsigned int half) const
      {
        const auto wall = wall_in_front(face, piece, half);
        return wall.has_edge ? past(face, piece, wall) : FlowPastEdge<dim>();
      }

    private:
      double
      plane(const GridIndex<dim> &face) const
      {
        return cut.block.planes().position(axis, face[axis]);
      }

      dealii::Point<dim>
      node(const unsigned int facet, const unsigned int k) const
      {
        return placed.positions[placed.surface.facets()[facet][k]];
      }

      /// Is it the only piece of its face that bounds the component?
      bool
      is_alone(const GridIndex<dim> &face, const int piece, const unsigned int half) const
      {
        int         n         = 0;
        const auto &pieces    = open.pieces[axis];
        const int   component = pieces[piece].components[half];
        for_each_part(open.faces[axis], face, [&](const int part) {
          n += pieces[part].components[half] == component;
        });
        return n == 1;
      }

      /// What faces a piece in the component below (0) or above (1) it.
      WallInFront<dim>
      wall_in_front(const GridIndex<dim> &face, const int piece, const unsigned int half) const
      {
        WallInFront<dim> result;
        const int        component = open.pieces[axis][piece].components[half];
        const int        of_cut    = component < 0 ? -1 : parts.cut_components[component];
        if (of_cut < 0 || !is_alone(face, piece, half))
          return result;
        const int cell = cut.components[of_cut].cell;
        for (int f = cut.cells[cell].first_fragment; f < cut.end_fragment(cell); ++f)
          {
            const auto  &fragment = cut.fragments[f];
            const double facing   = (half == 0 ? -1 : 1) * fragment.area_vector[axis];
            if (fragment.component != of_cut || !(facing > 0) ||
                facing < least_facing * fragment.area_vector.norm())
              continue;
            dealii::Tensor<1, dim> centroid;
            for (unsigned int k = 0; k < dim; ++k)
              centroid += fragment.mean[k] * node(fragment.facet, k);
            result.size += fragment.area_vector.norm();
            result.area += facing;
            result.volume += facing * std::abs(plane(face) - centroid[axis]);
            result.moment += facing * centroid;
            if (!result.has_edge)
              find_edge(result, f, cell);
          }
        return result;
      }

      /// A convex edge of a fragment's facet, beyond which the surface goes on in its component.
      void
      find_edge(WallInFront<dim> &result, const int fragment, const int cell) const
      {
        const auto &one    = cut.fragments[fragment];
        const auto  normal = -one.area_vector / one.area_vector.norm(); // out of the body
        const auto &nodes  = placed.surface.facets()[one.facet];
        for (int f = cut.cells[cell].first_fragment; f < cut.end_fragment(cell); ++f)
          {
            const auto &other = cut.fragments[f];
            if (other.component != one.component || !(other.area_vector.norm() > 0) ||
                -(other.area_vector * normal) >= smooth_wall * other.area_vector.norm())
              continue;
            const auto apex = node_beyond(nodes, placed.surface.facets()[other.facet]);
            if (!apex || (placed.positions[*apex] - node(one.facet, 0)) * normal >= 0)
              continue;
            std::copy(nodes.begin(), nodes.end(), result.simplex.begin());
            result.simplex[dim] = *apex;
            result.has_edge     = true;
            return;
          }
      }

      /// The node of a facet that is not one of a neighbour's; nothing if they have no common edge.
      static std::optional<unsigned int>
      node_beyond(const typename Surface<dim>::Facet &neighbour,
                  const typename Surface<dim>::Facet &facet)
      {
        std::optional<unsigned int> result;
        for (const unsigned int node : facet)
          if (std::find(neighbour.begin(), neighbour.end(), node) == neighbour.end())
            {
              if (result)
                return {};
              result = node;
            }
        return result;
      }

      /// Along the direction in which the edge is away from the wall. It counts less where what is
      /// free of the piece is too narrow (nothing jumps as an edge comes into a cell), where it is
      /// free on both sides of a wall (one velocity says nothing of either), and where facets are
      /// so small that those beside the edge do not tell the velocity of the fluid that is held
      /// back.
      FlowPastEdge<dim>
      past(const GridIndex<dim> &face, const int piece, const WallInFront<dim> &wall) const
      {
        FlowPastEdge<dim> result;
        const auto       &shape  = open.faces[axis].all()[piece];
        auto              offset = wall.moment / wall.area - dealii::Tensor<1, dim>(shape.place);
        offset[axis]             = 0;
        const unsigned int d     = main_direction(axis, offset);
        const double       across =
          grid.face_area(axis, shape.index) / grid.cell_width(d, shape.index[d]);
        const double length = shape.measure / across, behind = wall.area / across;
        const double free = length - behind, distance = wall.volume / wall.area;
        if (!(free > negligible * length) || !(offset.norm() > 0))
          return result;
        const double sign       = offset[d] > 0 ? -1 : 1;
        const auto   shape_past = [&](const double passed) {
          result.factor    = length / passed;
          result.direction = d;
          result.shift[d]  = sign * (length - passed) / 2;
          auto held        = shape.place; // the centroid of what does not pass
          held[axis]       = plane(face);
          held[d] -= sign * passed / 2;
          result.weights = weights_in_simplex(wall.simplex, held);
        };
        const double passed =
          std::max(free + std::min(behind, widening * distance), length / most_factor);
        result.nodes = wall.simplex;
        shape_past(passed);
        const double farthest = -*std::min_element(result.weights.begin(), result.weights.end());
        const double counts =
          std::min(1., free / (room * distance)) * std::min(1., 2 * std::abs(offset[d]) / free) *
          std::clamp(
            (wall.area / wall.size - least_facing) / (most_facing - least_facing), 0., 1.) *
          std::clamp(2 - farthest / reach, 0., 1.);
        const double narrowed = counts * (length - passed);
        if (!(narrowed > negligible * length))
          return {};
        shape_past(length - narrowed);
        return result;
      }

      /// The barycentric coordinates of a place in a facet and what follows beyond its edge: a
      /// velocity of the surface that is linear in space is exact there.
      std::array<double, dim + 1>
      weights_in_simplex(const std::array<unsigned int, dim + 1> &simplex,
                         const dealii::Point<dim>                &place) const
      {
        const auto             first = placed.positions[simplex[0]];
        dealii::Tensor<2, dim> matrix;
        for (unsigned int k = 0; k < dim; ++k)
          for (unsigned int d = 0; d < dim; ++d)
            matrix[d][k] = placed.positions[simplex[k + 1]][d] - first[d];
        const auto                  shares = invert(matrix) * (place - first);
        std::array<double, dim + 1> result{};
        result[0] = 1;
        for (unsigned int k = 0; k < dim; ++k)
          {
            result[k + 1] = shares[k];
            result[0] -= shares[k];
          }
        return result;
      }

      const MacGrid<dim>       &grid;
      const CutCells<dim>      &cut;
      const CutTopology<dim>   &parts;
      const FluidTopology<dim> &open;
      const PlacedSurface<dim> &placed;
      const unsigned int        axis;
    };


    /// Call `action(number)` for all that is to be known of one, each as a reference.
    template <int dim, class Action>
    void
    for_each_number(FlowPastEdge<dim> &one, const Action &action)
    {
      action(one.factor);
      action(one.direction);
      for (unsigned int d = 0; d < dim; ++d)
        action(one.shift[d]);
      for (unsigned int k = 0; k <= dim; ++k)
        {
          action(one.nodes[k]);
          action(one.weights[k]);
        }
    }


    /// What flows past edges in the cells below a periodic side, of which the ranks that own the
    /// faces on it know nothing; for these faces, each with a single piece. Collective.
    template <int dim>
    std::vector<std::pair<GridIndex<dim>, FlowPastEdge<dim>>>
    below_periodic_side(const MacGrid<dim>       &grid,
                        const CutCells<dim>      &cut,
                        const CutTopology<dim>   &parts,
                        const PiecesAtEdges<dim> &at_edges,
                        const unsigned int        axis)
    {
      std::vector<double> numbers;
      for (const auto &cell : cut.cells)
        if (const auto image = moved<dim>(cell.index, axis, 1);
            grid.cells()->owned().contains(cell.index) &&
            image[axis] == static_cast<int>(grid.cells_along()[axis]))
          for_each_part(parts.open->faces[axis], image, [&](const int part) {
            auto past = at_edges.beside(image, part, 0);
            if (!(past.factor > 1))
              return;
            for (unsigned int d = 0; d < dim; ++d)
              numbers.push_back(d == axis ? 0 : image[d]);
            for_each_number(past, [&](const auto &number) { numbers.push_back(number); });
          });
      std::vector<std::pair<GridIndex<dim>, FlowPastEdge<dim>>> result;
      for (const auto &of_rank : dealii::Utilities::MPI::all_gather(grid.communicator(), numbers))
        for (std::size_t n = 0; n < of_rank.size();)
          {
            auto &[face, past] = result.emplace_back();
            for (unsigned int d = 0; d < dim; ++d)
              face[d] = of_rank[n++];
            for_each_number(past, [&](auto &number) { number = of_rank[n++]; });
          }
      return result;
    }


    /// Get those of pieces that other ranks own. Collective.
    template <int dim>
    void
    exchange(std::vector<FlowPastEdge<dim>> &all, const SubLattice<dim> &pieces)
    {
      std::vector<std::vector<double>> numbers; // [number][piece]
      for (std::size_t k = 0; k < all.size(); ++k)
        {
          unsigned int n = 0;
          for_each_number(all[k], [&](const auto &number) {
            if (n == numbers.size())
              numbers.emplace_back(all.size());
            numbers[n++][k] = number;
          });
        }
      constexpr unsigned int n_numbers = 4 + 3 * dim;
      numbers.resize(n_numbers); // on ranks without pieces
      for (auto &values : numbers)
        pieces.exchange(values);
      for (std::size_t k = 0; k < all.size(); ++k)
        {
          unsigned int n = 0;
          for_each_number(all[k], [&](auto &number) { number = numbers[n++][k]; });
        }
    }
  } // namespace


  template <int dim>
  std::vector<FlowPastEdge<dim>>
  flow_past_edges(const MacGrid<dim>       &grid,
                  const CutCells<dim>      &cut,
                  const CutTopology<dim>   &parts,
                  const PlacedSurface<dim> &placed,
                  const unsigned int        axis)
  {
    const auto                    &pieces = parts.open->faces[axis];
    const PiecesAtEdges<dim>       at_edges(grid, cut, parts, placed, axis);
    std::vector<FlowPastEdge<dim>> result(pieces.all().size());
    const auto                     keep = [&](const int piece, const FlowPastEdge<dim> &found) {
      if (found.factor > result[piece].factor)
        result[piece] = found;
    };
    for (std::size_t k = 0; k < result.size(); ++k)
      if (pieces.owns(k))
        for (const unsigned int half : {0, 1})
          if (const auto &face = pieces.all()[k].index;
              half == 1 || !grid.periodic(axis) || face[axis] > 0)
            keep(k, at_edges.beside(face, k, half));
    if (grid.periodic(axis))
      for (const auto &[face, found] : below_periodic_side(grid, cut, parts, at_edges, axis))
        if (grid.faces(axis)->owned().contains(face))
          for_each_part(pieces, face, [&, &found = found](const int part) { keep(part, found); });
    const unsigned int n =
      std::count_if(result.begin(), result.end(), [](const auto &one) { return one.factor > 1; });
    if (dealii::Utilities::MPI::max(n, grid.communicator()) > 0)
      exchange(result, pieces);
    return result;
  }


#define INSTANTIATE(dim)                                                              \
  template std::vector<FlowPastEdge<dim>> flow_past_edges(const MacGrid<dim> &,       \
                                                          const CutCells<dim> &,      \
                                                          const CutTopology<dim> &,   \
                                                          const PlacedSurface<dim> &, \
                                                          const unsigned int);

  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace undine
