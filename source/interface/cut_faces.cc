// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/interface/cut_flags.h>
#include <undine/interface/cut_workspace.h>
#include <undine/interface/sampled_regions.h>

namespace undine
{
  namespace
  {
    template <int dim>
    void
    add_piece(CutCells<dim>            &cut,
              CutWorkspace<dim>        &work,
              const double              area,
              const dealii::Point<dim> &centroid,
              const bool                debris)
    {
      const int face = cut.faces.size() - 1;
      cut.pieces.push_back({face, area, centroid, {{cut.outside, cut.outside}}});
      work.debris_piece.push_back(debris);
      if (area <
          -reported_inversion * cut.block.face_area(cut.faces[face].axis, cut.faces[face].index))
        work.face_records[face].flags |= cut_negative_area;
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
        add_piece(cut, work, end - start, centroid, false);
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
    for (const auto &region : work.planar.regions())
      {
        dealii::Point<3> centroid;
        centroid[face.axis] = planes.position(face.axis, face.index[face.axis]);
        for (unsigned int d = 0; d < 2; ++d)
          centroid[axes[d]] = planes.position(axes[d], face.index[axes[d]]) + region.centroid(d);
        add_piece(cut, work, region.area, centroid, region.debris);
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
