// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/cutting/chord_splitter.h>

#include <algorithm>

namespace undine
{
  namespace
  {
    /// Linear interpolation that never leaves [a, b], so that it is monotone in s.
    double
    interpolate(const double a, const double b, const double s)
    {
      return std::clamp(a + s * (b - a), std::min(a, b), std::max(a, b));
    }
  } // namespace


  template <int dim>
  std::array<double, dim>
  barycentric(const Surface<dim>   &surface,
              const unsigned int    facet,
              const CutVertex<dim> &vertex,
              const int             vertex_number)
  {
    using Kind = typename CutVertex<dim>::Kind;
    std::array<double, dim> result{};
    const auto             &nodes = surface.facets()[facet];
    if (vertex.kind == Kind::in_facet)
      {
        result[0] = 1;
        for (unsigned int k = 1; k < dim; ++k)
          {
            result[k] = vertex.parameters[k - 1];
            result[0] -= result[k];
          }
      }
    else if (vertex.kind == Kind::node)
      for (unsigned int k = 0; k < dim; ++k)
        result[k] = static_cast<int>(nodes[k]) == vertex_number ? 1 : 0;
    else
      {
        const auto &ridge = surface.ridges()[vertex.ridge];
        for (unsigned int k = 0; k < dim; ++k)
          result[k] = nodes[k] == ridge.front()  ? 1 - vertex.parameters[0]
                      : nodes[k] == ridge.back() ? vertex.parameters[0]
                                                 : 0;
      }
    return result;
  }


  template <int dim>
  ChordSplitter<dim>::ChordSplitter(const GridBlock<dim> &block,
                                    const Surface<dim>   &surface,
                                    SplitSurface<dim>    &split,
                                    NodeWindings<dim>    &windings)
    : block(block)
    , surface(surface)
    , split(split)
    , windings(windings)
  {
  }


  template <int dim>
  CutVertex<dim>
  ChordSplitter<dim>::vertex_between(const CutVertex<dim> &from,
                                     const CutVertex<dim> &to,
                                     const unsigned int    axis,
                                     const int             plane,
                                     const double          fraction) const
  {
    CutVertex<dim> vertex;
    for (unsigned int d = 0; d < dim; ++d)
      if (d == axis)
        {
          vertex.position[d] = block.planes().position(d, plane);
          vertex.slabs[d]    = plane;
        }
      else
        {
          vertex.position[d]              = interpolate(from.position[d], to.position[d], fraction);
          const std::pair<int, int> slabs = std::minmax({from.slabs[d], to.slabs[d]});
          vertex.slabs[d] =
            slabs.first == slabs.second
              ? slabs.first
              : block.planes().slab_between(d, vertex.position[d], slabs.first, slabs.second);
        }
    vertex.plane = plane;
    vertex.axis  = axis;
    return vertex;
  }


  template <int dim>
  template <class Complete>
  void
  ChordSplitter<dim>::split_segment(std::vector<SplitPoint> &parts,
                                    const int                from,
                                    const int                to,
                                    const unsigned int       axis,
                                    const Complete          &complete)
  {
    const int first = split.vertices[from].slabs[axis];
    const int last  = split.vertices[to].slabs[axis];
    const int step  = last > first ? 1 : -1;
    for (int slab = first; slab != last; slab += step)
      {
        const int    plane = step > 0 ? slab + 1 : slab;
        const auto  &a     = split.vertices[from];
        const auto  &b     = split.vertices[to];
        const double fraction =
          std::clamp((block.planes().position(axis, plane) - a.position[axis]) /
                       (b.position[axis] - a.position[axis]),
                     0.,
                     1.);
        auto vertex = vertex_between(a, b, axis, plane, fraction);
        complete(vertex, fraction);
        parts.push_back({static_cast<int>(split.vertices.size()), slab + step});
        split.vertices.push_back(vertex);
      }
  }


  template <int dim>
  void
  ChordSplitter<dim>::split_ridge(std::vector<SplitPoint> &parts,
                                  const int                from,
                                  const int                to,
                                  const unsigned int       axis,
                                  const unsigned int       ridge)
  {
    using Kind           = typename CutVertex<dim>::Kind;
    const auto parameter = [&](const int number) {
      const auto &vertex = split.vertices[number];
      return vertex.kind == Kind::on_ridge
               ? vertex.parameters[0]
               : (static_cast<int>(surface.ridges()[ridge].back()) == number ? 1. : 0.);
    };
    const double start = parameter(from), end = parameter(to);
    split_segment(parts, from, to, axis, [&](CutVertex<dim> &vertex, const double fraction) {
      vertex.kind          = Kind::on_ridge;
      vertex.ridge         = ridge;
      vertex.parameters    = {};
      vertex.parameters[0] = interpolate(start, end, fraction);
    });
  }


  template <int dim>
  void
  ChordSplitter<dim>::split_in_facet(std::vector<SplitPoint> &parts,
                                     const int                from,
                                     const int                to,
                                     const unsigned int       axis,
                                     const unsigned int       facet)
  {
    if (split.vertices[from].slabs[axis] == split.vertices[to].slabs[axis])
      return;
    const auto start = barycentric(surface, facet, split.vertices[from], from);
    const auto end   = barycentric(surface, facet, split.vertices[to], to);
    split_segment(parts, from, to, axis, [&](CutVertex<dim> &vertex, const double fraction) {
      vertex.kind  = CutVertex<dim>::Kind::in_facet;
      vertex.ridge = -1;
      for (unsigned int k = 1; k < dim; ++k)
        vertex.parameters[k - 1] = interpolate(start[k], end[k], fraction);
    });
  }


  template <int dim>
  void
  ChordSplitter<dim>::split_chord(std::vector<Link> &links,
                                  const unsigned int facet,
                                  const unsigned int normal,
                                  const unsigned int axis,
                                  GridIndex<dim>     place,
                                  const int          from,
                                  const int          to)
  {
    if (axis == dim)
      {
        links.push_back({add_chord(facet, normal, place, from, to), to});
        return;
      }
    auto &parts = scratch[axis];
    parts.clear();
    split_in_facet(parts, from, to, axis, facet);
    const int direction =
      split.vertices[to].slabs[axis] > split.vertices[from].slabs[axis] ? 1 : -1;
    place[axis]  = split.vertices[from].slabs[axis];
    int previous = from;
    for (const auto &part : parts)
      {
        split_chord(links, facet, normal, axis + 1, place, previous, part.vertex);
        add_crossing(facet, normal, axis, place, part.vertex, direction);
        place[axis] = part.slab;
        previous    = part.vertex;
      }
    split_chord(links, facet, normal, axis + 1, place, previous, to);
  }


  template <int dim>
  int
  ChordSplitter<dim>::add_chord(const unsigned int    facet,
                                const unsigned int    normal,
                                const GridIndex<dim> &place,
                                const int             from,
                                const int             to)
  {
    const int edge = split.new_edge();
    for (unsigned int d = 0; d < dim; ++d)
      if (place[d] < block.cells().lower[d] ||
          place[d] >= block.cells().upper[d] + (d == normal ? 1 : 0))
        return edge;
    split.chords_on.append(block.key(place, normal % dim));
    split.chords.push_back({from, to, edge, static_cast<int>(facet)});
    return edge;
  }


  template <int dim>
  void
  ChordSplitter<dim>::add_crossing(const unsigned int    facet,
                                   const unsigned int    normal,
                                   const unsigned int    axis,
                                   const GridIndex<dim> &place,
                                   const int             vertex,
                                   const int             direction)
  {
    const unsigned int along = 3 - normal - axis;
    GridIndex<dim>     line  = place;
    line[axis]               = split.vertices[vertex].plane;
    if (along > axis)
      line[along] = split.vertices[vertex].slabs[along];
    for (unsigned int d = 0; d < dim; ++d)
      if (d == along ? !matters(d, line[d])
                     : line[d] < block.nodes().lower[d] || line[d] >= block.nodes().upper[d])
        return;

    // The fluid is on the left of the chord: (normal, axis, along) right-handed or not.
    const int sign = (axis + 3 - normal) % 3 == 1 ? -direction : direction;
    if (along == 0)
      windings.add_crossing(block, moved(line, 0, 1), sign);
    if (line[along] < block.cells().lower[along])
      return;
    split.crossings_on.append(block.key(line, along));
    split.crossings.push_back({vertex, sign, static_cast<int>(facet)});
  }


  template std::array<double, 2>
  barycentric<2>(const Surface<2> &, const unsigned int, const CutVertex<2> &, const int);
  template std::array<double, 3>
  barycentric<3>(const Surface<3> &, const unsigned int, const CutVertex<3> &, const int);
  template class ChordSplitter<2>;
  template class ChordSplitter<3>;
} // namespace undine
