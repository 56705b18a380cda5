// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/cutting/facet_splitter.h>

#include <limits>

namespace undine
{
  FacetSplitter<2>::FacetSplitter(const GridBlock<2> &block,
                                  const Surface<2>   &surface,
                                  SplitSurface<2>    &split,
                                  NodeWindings<2>    &windings)
    : surface(surface)
    , chord_splitter(block, surface, split, windings)
  {
  }


  void
  FacetSplitter<2>::split_facet(const unsigned int facet)
  {
    // The solid is on the left of the segment, so that the fluid is on the left of the reversed
    // segment.
    links.clear();
    chord_splitter.split_chord(
      links, facet, 2, 0, {}, surface.facets()[facet][1], surface.facets()[facet][0]);
  }


  FacetSplitter<3>::FacetSplitter(const GridBlock<3> &block,
                                  const Surface<3>   &surface,
                                  SplitSurface<3>    &split,
                                  NodeWindings<3>    &windings)
    : block(block)
    , surface(surface)
    , split(split)
    , chord_splitter(block, surface, split, windings)
    , chains(surface.ridges().size())
  {
  }


  const FacetSplitter<3>::Chain &
  FacetSplitter<3>::chain(const unsigned int ridge)
  {
    Chain &result = chains[ridge];
    if (result.begin >= 0)
      return result;
    const auto &ends = surface.ridges()[ridge];
    ridge_vertices.assign({static_cast<int>(ends[0]), static_cast<int>(ends[1])});
    for (unsigned int axis = 0; axis < 3; ++axis)
      {
        finer_vertices.clear();
        for (std::size_t i = 0; i + 1 < ridge_vertices.size(); ++i)
          {
            finer_vertices.push_back(ridge_vertices[i]);
            parts.clear();
            chord_splitter.split_ridge(
              parts, ridge_vertices[i], ridge_vertices[i + 1], axis, ridge);
            for (const auto &part : parts)
              finer_vertices.push_back(part.vertex);
          }
        finer_vertices.push_back(ridge_vertices.back());
        ridge_vertices.swap(finer_vertices);
      }
    result.begin = chain_vertices.size();
    chain_vertices.insert(
      chain_vertices.end(), ridge_vertices.begin() + 1, ridge_vertices.end() - 1);
    result.end        = chain_vertices.size();
    result.first_edge = split.n_edges;
    split.n_edges += result.end - result.begin + 1;
    return result;
  }


  void
  FacetSplitter<3>::collect_rim(const unsigned int facet)
  {
    Polygon    &rim   = polygons[0];
    const auto &nodes = surface.facets()[facet];
    rim.clear();
    for (unsigned int k = 0; k < 3; ++k)
      {
        const unsigned int ridge  = surface.ridges(facet)[k];
        const Chain       &chain  = this->chain(ridge);
        const int          length = chain.end - chain.begin;
        if (surface.ridges()[ridge][0] == nodes[k])
          {
            rim.push_back({static_cast<int>(nodes[k]), chain.first_edge});
            for (int i = 0; i < length; ++i)
              rim.push_back({chain_vertices[chain.begin + i], chain.first_edge + i + 1});
          }
        else
          {
            rim.push_back({static_cast<int>(nodes[k]), chain.first_edge + length});
            for (int i = length; i-- > 0;)
              rim.push_back({chain_vertices[chain.begin + i], chain.first_edge + i});
          }
      }
  }


  void
  FacetSplitter<3>::split_facet(const unsigned int facet)
  {
    current_facet = facet;
    collect_rim(facet);
    slice(0, {});
  }


  void
  FacetSplitter<3>::slice(const unsigned int axis, const GridIndex<3> &place)
  {
    Polygon &polygon = polygons[axis];
    int      lowest  = std::numeric_limits<int>::max();
    int      highest = std::numeric_limits<int>::min();
    int      inside  = -1; // a vertex that lies on no plane of this axis, or of a later one
    for (const auto &corner : polygon)
      {
        const auto &vertex = split.vertices[corner.vertex];
        if (vertex.axis == static_cast<int>(axis))
          {
            lowest  = std::min(lowest, vertex.plane);
            highest = std::max(highest, vertex.plane);
          }
        else if (inside < 0 && vertex.axis < static_cast<int>(axis))
          inside = corner.vertex;
      }
    if (highest < lowest)
      {
        if (inside < 0)
          ++split.failures;
        else
          pass_on(axis, polygon, split.vertices[inside].slabs[axis], place);
        return;
      }
    for (int plane = lowest; plane <= highest; ++plane)
      {
        if (!cut_off(axis, plane, place))
          {
            ++split.failures;
            return;
          }
        pass_on(axis, lower_parts[axis], plane - 1, place);
      }
    pass_on(axis, polygon, highest, place);
  }


  bool
  FacetSplitter<3>::cut_off(const unsigned int axis, const int plane, const GridIndex<3> &place)
  {
    Polygon          &polygon = polygons[axis];
    const std::size_t n       = polygon.size();
    std::size_t       a = 0, b = 0, meetings = 0;
    for (std::size_t i = 0; i < n; ++i)
      {
        const auto &vertex = split.vertices[polygon[i].vertex];
        if (vertex.axis == static_cast<int>(axis) && vertex.plane == plane)
          (meetings++ == 0 ? a : b) = i;
      }
    if (meetings != 2)
      return false;
    int above = side(axis, plane, a, b);
    if (above == 0)
      above = -side(axis, plane, b, a + n);
    if (above > 0)
      std::swap(a, b); // now the corners from a to b bound the lower part

    auto chord_place  = place;
    chord_place[axis] = plane;
    links.clear();
    chord_splitter.split_chord(
      links, current_facet, axis, axis + 1, chord_place, polygon[b].vertex, polygon[a].vertex);

    const auto copy = [&](Polygon &part, const std::size_t first, const std::size_t last) {
      part.clear();
      for (std::size_t i = first;; i = (i + 1) % n)
        {
          part.push_back(polygon[i]);
          if (i == last)
            break;
        }
    };
    Polygon &lower = lower_parts[axis], &upper = upper_parts[axis];
    copy(lower, a, b);
    copy(upper, b, a);
    lower.back().edge = links.front().edge;
    upper.back().edge = links.back().edge;
    for (std::size_t i = 0; i + 1 < links.size(); ++i)
      lower.push_back({links[i].vertex, links[i + 1].edge});
    for (std::size_t i = links.size() - 1; i-- > 0;)
      upper.push_back({links[i].vertex, links[i].edge});
    polygon.swap(upper);
    return true;
  }


  int
  FacetSplitter<3>::side(const unsigned int axis,
                         const int          plane,
                         const std::size_t  a,
                         const std::size_t  b) const
  {
    const Polygon &polygon = polygons[axis];
    for (std::size_t i = a + 1; i < b; ++i)
      {
        const auto &vertex = split.vertices[polygon[i % polygon.size()].vertex];
        if (vertex.axis < static_cast<int>(axis))
          return vertex.slabs[axis] >= plane ? 1 : -1;
        if (vertex.axis == static_cast<int>(axis) && vertex.plane != plane)
          return vertex.plane > plane ? 1 : -1;
      }
    return 0;
  }


  void
  FacetSplitter<3>::pass_on(const unsigned int axis,
                            const Polygon     &slice,
                            const int          slab,
                            GridIndex<3>       place)
  {
    if (!chord_splitter.matters(axis, slab))
      return;
    place[axis] = slab;
    if (axis < 2)
      {
        // Below the block only crossings of lines of axis 0 matter, which slicing by axis 1 gives.
        if (axis == 1 && place[0] < block.cells().lower[0])
          return;
        polygons[axis + 1] = slice;
        this->slice(axis + 1, place);
        return;
      }
    split.fragments_in.append(block.key(place));
    split.fragments.push_back({static_cast<int>(current_facet),
                               static_cast<int>(split.corners.size()),
                               static_cast<int>(split.corners.size() + slice.size())});
    split.corners.insert(split.corners.end(), slice.begin(), slice.end());
  }


  namespace
  {
    /// Whether a facet can leave anything in the block, or crossings below it along axis 0.
    template <int dim>
    bool
    comes_near(const std::array<unsigned int, dim> &facet,
               const std::vector<CutVertex<dim>>   &vertices,
               const ChordSplitter<dim>            &splitter)
    {
      for (unsigned int d = 0; d < dim; ++d)
        {
          int lowest = vertices[facet[0]].slabs[d], highest = lowest;
          for (const unsigned int node : facet)
            {
              lowest  = std::min(lowest, vertices[node].slabs[d]);
              highest = std::max(highest, vertices[node].slabs[d]);
            }
          // Slabs are clamped to one beyond the block.
          if (lowest == highest && !splitter.matters(d, lowest))
            return false;
        }
      return true;
    }


    /// The nodes as vertices of the split surface.
    template <int dim>
    void
    add_nodes(SplitSurface<dim>                     &split,
              const GridBlock<dim>                  &block,
              const std::vector<dealii::Point<dim>> &positions)
    {
      CutVertex<dim> vertex;
      vertex.parameters = {};
      vertex.ridge      = -1;
      vertex.plane      = 0;
      vertex.axis       = -1;
      vertex.kind       = CutVertex<dim>::Kind::node;
      split.vertices.reserve(4 * positions.size());
      for (const auto &position : positions)
        {
          vertex.position = position;
          for (unsigned int d = 0; d < dim; ++d)
            vertex.slabs[d] = block.clamped(d, block.planes().slab(d, position[d]));
          split.vertices.push_back(vertex);
        }
    }
  } // namespace


  template <int dim>
  void
  split_surface(SplitSurface<dim>                     &split,
                NodeWindings<dim>                     &windings,
                const GridBlock<dim>                  &block,
                const Surface<dim>                    &surface,
                const std::vector<dealii::Point<dim>> &positions)
  {
    split.clear();
    windings.reset(block);
    add_nodes(split, block, positions);
    ChordSplitter<dim> chord_splitter(block, surface, split, windings);
    FacetSplitter<dim> facet_splitter(block, surface, split, windings);
    for (unsigned int facet = 0; facet < surface.facets().size(); ++facet)
      if (comes_near<dim>(surface.facets()[facet], split.vertices, chord_splitter))
        facet_splitter.split_facet(facet);
  }


  template <int dim>
  std::vector<unsigned int>
  facets_near(const GridBlock<dim>                  &block,
              const Surface<dim>                    &surface,
              const std::vector<dealii::Point<dim>> &positions)
  {
    SplitSurface<dim> split;
    NodeWindings<dim> windings;
    add_nodes(split, block, positions);
    const ChordSplitter<dim>  chord_splitter(block, surface, split, windings);
    std::vector<unsigned int> result;
    for (unsigned int facet = 0; facet < surface.facets().size(); ++facet)
      if (comes_near<dim>(surface.facets()[facet], split.vertices, chord_splitter))
        result.push_back(facet);
    return result;
  }


  // clang-format off
#define INSTANTIATE(dim)                                                                           \
  template void split_surface(SplitSurface<dim> &, NodeWindings<dim> &, const GridBlock<dim> &,    \
                              const Surface<dim> &, const std::vector<dealii::Point<dim>> &);      \
  template std::vector<unsigned int> facets_near(const GridBlock<dim> &, const Surface<dim> &,     \
                                                 const std::vector<dealii::Point<dim>> &);
  // clang-format on
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace undine
