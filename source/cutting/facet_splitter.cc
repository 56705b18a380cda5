// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/cutting/facet_splitter.h>

namespace undine
{
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
  } // namespace


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


  namespace
  {
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
