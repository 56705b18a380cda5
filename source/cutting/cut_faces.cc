// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/cutting/cut_flags.h>
#include <undine/cutting/cut_workspace.h>
#include <undine/cutting/sampled_regions.h>

#include <algorithm>

namespace undine
{
  namespace
  {
    /// Append a piece of the last face. Whether it is debris is to be said in `work.debris_piece`.
    template <int dim>
    void
    add_piece(CutCells<dim>            &cut,
              CutWorkspace<dim>        &work,
              const double              area,
              const dealii::Point<dim> &centroid,
              const PieceShape<dim>    &shape)
    {
      const int face = cut.faces.size() - 1;
      cut.pieces.push_back({face, area, centroid, {{cut.outside, cut.outside}}, shape});
      if (area <
          -reported_inversion * cut.block.face_area(cut.faces[face].axis, cut.faces[face].index))
        work.face_records[face].flags |= cut_negative_area;
    }


    /// Add an interval of the rim, which lies along one of the rectangle's `axes`, to that of its
    /// region.
    void
    add_to_rim(Rims<3>                           &rims,
               const PlanarEdge                  &edge,
               const GridPlanes<3>               &planes,
               const GridIndex<3>                &corner,
               const std::array<unsigned int, 2> &axes)
    {
      const std::array<double, 2> size{
        {std::abs(edge.end[0] - edge.start[0]), std::abs(edge.end[1] - edge.start[1])}};
      const unsigned int along = size[0] > size[1] ? 0 : 1, across = 1 - along;
      const unsigned int end =
        edge.start[across] > planes.width(axes[across], corner[axes[across]]) / 2 ? 1 : 0;
      auto        &rim    = rims[2 * axes[across] + end];
      const double length = size[along];
      const double middle = planes.position(axes[along], corner[axes[along]]) +
                            (edge.start[along] + edge.end[along]) / 2;
      if (length > 0)
        rim = {rim.length + length,
               (rim.length * rim.middle + length * middle) / (rim.length + length)};
    }


    /// The mean of min(x, 0) over a segment along which x goes from `start` to `end`.
    double
    mean_of_negative(const double start, const double end)
    {
      const double lower = std::min(start, end), upper = std::max(start, end);
      return upper <= 0   ? (lower + upper) / 2
             : lower >= 0 ? 0.
                          : lower * lower / (lower - upper) / 2;
    }


    /// Add what an edge contributes, by Green's theorem, to the areas of its region in the lower
    /// halves of the rectangle: of min(x - middle, 0), whose derivative is one there.
    void
    add_to_lower_halves(std::array<double, 3>             &lower_half,
                        const PlanarEdge                  &edge,
                        const GridPlanes<3>               &planes,
                        const GridIndex<3>                &corner,
                        const std::array<unsigned int, 2> &axes)
    {
      for (const unsigned int d : {0, 1})
        {
          const double middle = planes.width(axes[d], corner[axes[d]]) / 2;
          const double along  = edge.end[1 - d] - edge.start[1 - d];
          lower_half[axes[d]] += (d == 0 ? along : -along) *
                                 mean_of_negative(edge.start[d] - middle, edge.end[d] - middle);
        }
    }


    /// Of all regions of the planar problem on a face.
    std::vector<PieceShape<3>>
    shapes_of_regions(const CutWorkspace<3>             &work,
                      const GridPlanes<3>               &planes,
                      const GridIndex<3>                &corner,
                      const std::array<unsigned int, 2> &axes)
    {
      std::vector<PieceShape<3>> result(work.planar.regions().size());
      const auto                &record = work.face_records.back();
      for (int i = record.first_planar; i < record.end_planar; ++i)
        if (const auto &edge = work.planar_edges[i]; edge.region >= 0)
          {
            add_to_lower_halves(result[edge.region].lower_half, edge, planes, corner, axes);
            if (edge.on_rim)
              add_to_rim(result[edge.region].rims, edge, planes, corner, axes);
          }
      return result;
    }
  } // namespace


  void
  solve_face(CutCells<2> &cut, CutWorkspace<2> &work, const PlacedSurface<2> &placed)
  {
    const auto         face  = cut.faces.back();
    const unsigned int along = 1 - face.axis;
    const auto         edge  = work.grid_edges.edge(
      cut.block, placed.surface, placed.positions, cut.windings, work.split, face.index, along);
    work.face_records.back().flags |= edge.flags;
    const auto position = [&](const int end) {
      return end >= 0 ? work.split.vertices[end].position[along]
                      : cut.block.planes().position(along, cut.block.node(-1 - end)[along]);
    };
    for (int i = edge.begin; i < edge.end; ++i)
      {
        const auto      &interval = work.grid_edges.interval(i);
        const double     start = position(interval.from), end = position(interval.to);
        dealii::Point<2> centroid;
        centroid[face.axis] = cut.block.planes().position(face.axis, face.index[face.axis]);
        centroid[along]     = (start + end) / 2;
        const double middle = cut.block.planes().position(along, face.index[along]) +
                              cut.block.planes().width(along, face.index[along]) / 2;
        PieceShape<2> shape;
        shape.rims[2 * along].length     = interval.from < 0 ? 1 : 0; // a node of the grid
        shape.rims[2 * along + 1].length = interval.to < 0 ? 1 : 0;
        shape.lower_half[along]          = std::min(end, middle) - std::min(start, middle);
        add_piece(cut, work, end - start, centroid, shape);
        work.debris_piece.push_back(false);
      }
  }


  void
  solve_face(CutCells<3> &cut, CutWorkspace<3> &work, const PlacedSurface<3> &placed)
  {
    const auto                       &face   = cut.faces.back();
    const auto                       &planes = cut.block.planes();
    auto                             &record = work.face_records.back();
    const std::array<unsigned int, 2> axes{{(face.axis + 1) % 3, (face.axis + 2) % 3}};

    record.first_planar = work.planar_edges.size();
    record.flags |= collect_rectangle(work.planar_edges, work, cut, placed, face.axis, face.index);
    record.end_planar = work.planar_edges.size();

    const double rounding = std::max(planes.rounding(axes[0], face.index[axes[0]]),
                                     planes.rounding(axes[1], face.index[axes[1]])) *
                            cut.block.face_area(face.axis, face.index);
    record.flags |=
      work.planar.find_regions(work.planar_edges, record.first_planar, record.end_planar, rounding);
    if (record.flags & cut_needs_sampling)
      {
        sample_face(cut, work);
        return;
      }
    const auto shapes = shapes_of_regions(work, planes, face.index, axes);
    for (std::size_t r = 0; r < shapes.size(); ++r)
      {
        const auto      &region = work.planar.regions()[r];
        dealii::Point<3> centroid;
        centroid[face.axis] = planes.position(face.axis, face.index[face.axis]);
        for (unsigned int d = 0; d < 2; ++d)
          centroid[axes[d]] = planes.position(axes[d], face.index[axes[d]]) + region.centroid(d);
        add_piece(cut, work, region.area, centroid, shapes[r]);
        work.debris_piece.push_back(region.debris);
      }
    if (record.flags & cut_needs_sampling) // a piece of negative area
      {
        cut.pieces.erase(cut.pieces.begin() + face.first_piece, cut.pieces.end());
        work.debris_piece.resize(face.first_piece);
        sample_face(cut, work);
      }
  }


  template <int dim>
  int
  find_face(CutCells<dim>            &cut,
            CutWorkspace<dim>        &work,
            const PlacedSurface<dim> &placed,
            const unsigned int        axis,
            const GridIndex<dim>     &index)
  {
    const int number = cut.face_slots.add(cut.block.key(index, axis));
    if (number < static_cast<int>(cut.faces.size()))
      return number;
    cut.faces.push_back({axis, index, static_cast<int>(cut.pieces.size())});
    work.face_records.emplace_back();
    solve_face(cut, work, placed);
    work.face_records.back().end_piece = cut.pieces.size();
    return number;
  }


  template int
  find_face(CutCells<2> &,
            CutWorkspace<2> &,
            const PlacedSurface<2> &,
            const unsigned int,
            const GridIndex<2> &);
  template int
  find_face(CutCells<3> &,
            CutWorkspace<3> &,
            const PlacedSurface<3> &,
            const unsigned int,
            const GridIndex<3> &);
} // namespace undine
