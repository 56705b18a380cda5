// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/interface/sampled_regions.h>
#include <undine/interface/simplex.h>

namespace undine
{
  namespace
  {
    /// Corners of a fragment as simplices: a polygon becomes a fan of triangles. @{
    void
    add_simplices(std::vector<SampledRegions<2>::Simplex> &simplices,
                  const std::vector<dealii::Point<2>>     &points,
                  const int                                begin,
                  const int)
    {
      simplices.push_back({{points[begin], points[begin + 1]}});
    }

    void
    add_simplices(std::vector<SampledRegions<3>::Simplex> &simplices,
                  const std::vector<dealii::Point<3>>     &points,
                  const int                                begin,
                  const int                                end)
    {
      for (int i = begin + 2; i < end; ++i)
        simplices.push_back({{points[begin], points[i - 1], points[i]}});
    }
    /// @}


    /// A place on the fluid's side of a fragment, as far from it as samples are from each other.
    template <int dim>
    dealii::Point<dim>
    in_front_of(const CutCells<dim> &cut, const int fragment, const GridIndex<dim> &cell)
    {
      dealii::Point<dim> centre;
      const int          begin = cut.corners.first[fragment], end = cut.corners.first[fragment + 1];
      for (int i = begin; i < end; ++i)
        centre += (cut.corners.points[i] - dealii::Point<dim>()) / (end - begin);
      const auto  &normal = cut.fragments[fragment].area_vector;
      const double size   = normal.norm();
      for (unsigned int d = 0; d < dim && size > 0; ++d)
        centre[d] -=
          normal[d] / size * cut.block.planes().width(d, cell[d]) / SampledRegions<dim>::n_along;
      return centre;
    }
  } // namespace


  template <int dim>
  SampledRegions<dim>
  sample_fluid(const CutCells<dim> &cut, const int cell)
  {
    std::vector<typename SampledRegions<dim>::Simplex> simplices;
    for (int f = cut.cells[cell].first_fragment; f < cut.end_fragment(cell); ++f)
      add_simplices(simplices, cut.corners.points, cut.corners.first[f], cut.corners.first[f + 1]);
    const auto            &index = cut.cells[cell].index;
    dealii::Point<dim>     lower;
    dealii::Tensor<1, dim> widths;
    for (unsigned int d = 0; d < dim; ++d)
      {
        lower[d]  = cut.block.planes().position(d, index[d]);
        widths[d] = cut.block.planes().width(d, index[d]);
      }
    return SampledRegions<dim>(lower, widths, cut.windings[cut.block.key(index)], simplices);
  }


  void
  sample_face(CutCells<3> &cut, CutWorkspace<3> &work)
  {
    // In the plane of the face a chord is a facet: the fluid is on its left.
    const auto                       &face   = cut.faces.back();
    const auto                       &planes = cut.block.planes();
    const auto                       &record = work.face_records.back();
    const std::array<unsigned int, 2> axes{{(face.axis + 1) % 3, (face.axis + 2) % 3}};

    std::vector<SampledRegions<2>::Simplex> simplices;
    for (int i = record.first_planar; i < record.end_planar; ++i)
      if (const auto &edge = work.planar_edges[i]; !edge.on_rim)
        simplices.push_back({{dealii::Point<2>(edge.end[0], edge.end[1]),
                              dealii::Point<2>(edge.start[0], edge.start[1])}});
    const dealii::Tensor<1, 2> widths(
      {planes.width(axes[0], face.index[axes[0]]), planes.width(axes[1], face.index[axes[1]])});
    const SampledRegions<2> sampled({}, widths, cut.windings[cut.block.key(face.index)], simplices);
    for (const auto &region : sampled.regions())
      {
        dealii::Point<3> centroid;
        centroid[face.axis] = planes.position(face.axis, face.index[face.axis]);
        for (unsigned int d = 0; d < 2; ++d)
          centroid[axes[d]] = planes.position(axes[d], face.index[axes[d]]) + region.centroid[d];
        cut.pieces.push_back({static_cast<int>(cut.faces.size()) - 1,
                              region.volume,
                              centroid,
                              {{cut.outside, cut.outside}}});
        work.debris_piece.push_back(false);
      }
    ++cut.counts.sampled_faces;
  }


  template <int dim>
  void
  sample_cell(CutCells<dim> &cut, const CutWorkspace<dim> &work)
  {
    const int   number  = cut.cells.size() - 1;
    const auto &cell    = cut.cells.back();
    const auto  sampled = sample_fluid(cut, number);

    cut.components.resize(cell.first_component);
    for (const auto &region : sampled.regions())
      cut.components.push_back({number, region.volume, region.centroid});
    // Pieces that are open without a sample in the fluid behind them join a component of no volume.
    const auto component = [&](const dealii::Point<dim> &place) {
      return sampled.regions().empty() ? static_cast<int>(cut.components.size()) - 1
                                       : cell.first_component + sampled.nearest(place);
    };
    for (unsigned int axis = 0; axis < dim; ++axis)
      for (const int end : {0, 1})
        {
          const int face = cut.face_slots.find(cut.block.key(moved(cell.index, axis, end), axis));
          for (int p = cut.faces[face].first_piece; p < work.face_records[face].end_piece; ++p)
            {
              auto &piece = cut.pieces[p];
              if (static_cast<int>(cut.components.size()) == cell.first_component)
                cut.components.push_back({number, 0., piece.centroid});
              piece.components[1 - end] = component(piece.centroid);
            }
        }
    for (int f = cell.first_fragment; f < cut.end_fragment(number); ++f)
      cut.fragments[f].component = static_cast<int>(cut.components.size()) == cell.first_component
                                     ? cut.no_component
                                     : component(in_front_of(cut, f, cell.index));
    ++cut.counts.sampled_cells;
  }


  template SampledRegions<2>
  sample_fluid(const CutCells<2> &, const int);
  template SampledRegions<3>
  sample_fluid(const CutCells<3> &, const int);
  template void
  sample_cell(CutCells<2> &, const CutWorkspace<2> &);
  template void
  sample_cell(CutCells<3> &, const CutWorkspace<3> &);
} // namespace undine
