// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/cutting/sampled_regions.h>
#include <undine/surface/simplex.h>

#include <algorithm>
#include <cmath>

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


    /// In the corners of the cell or face at a node, in the order of SampledRegions: `axes` are
    /// those along it.
    template <int dim, std::size_t n>
    typename SampledRegions<static_cast<int>(n)>::CornerWindings
    corner_windings(const CutCells<dim>               &cut,
                    const GridIndex<dim>              &node,
                    const std::array<unsigned int, n> &axes)
    {
      typename SampledRegions<static_cast<int>(n)>::CornerWindings result;
      for (unsigned int corner = 0; corner < result.size(); ++corner)
        {
          auto place = node;
          for (unsigned int d = 0; d < n; ++d)
            place[axes[d]] += (corner >> d) & 1;
          result[corner] = cut.windings[cut.block.key(place)];
        }
      return result;
    }


    /// Into how many parts along each side to divide a facet: none larger than the distance of
    /// samples.
    template <int dim>
    int
    n_parts(const std::array<dealii::Point<dim>, dim> &nodes, const dealii::Tensor<1, dim> &widths)
    {
      constexpr int most = 6, all_along_cell = 12;
      double        extent = 0; // in widths of the cell
      for (const auto &node : nodes)
        for (unsigned int d = 0; d < dim; ++d)
          extent = std::max(extent, std::abs(node[d] - nodes[0][d]) / widths[d]);
      return static_cast<int>(std::clamp(std::ceil(extent * all_along_cell), 1., double(most)));
    }


    /// Centres of n equal parts of a segment, n^2 of a triangle. @{
    void
    add_centres(std::vector<dealii::Point<2>>    &centres,
                const SampledRegions<2>::Simplex &segment,
                const int                         n)
    {
      for (int i = 0; i < n; ++i)
        centres.push_back(segment[0] + (i + .5) / n * (segment[1] - segment[0]));
    }

    void
    add_centres(std::vector<dealii::Point<3>>    &centres,
                const SampledRegions<3>::Simplex &triangle,
                const int                         n)
    {
      const auto add = [&](const double i, const double j) {
        centres.push_back(triangle[0] + i / n * (triangle[1] - triangle[0]) +
                          j / n * (triangle[2] - triangle[0]));
      };
      for (int i = 0; i < n; ++i)
        for (int j = 0; i + j < n; ++j)
          {
            add(i + 1. / 3, j + 1. / 3);
            if (i + j < n - 1)
              add(i + 2. / 3, j + 2. / 3);
          }
    }
    /// @}


    /// The shape of a piece of which only the area is known: rims at most as long as there are.
    PieceShape<3>
    mean_shape(const GridPlanes<3>               &planes,
               const GridIndex<3>                &corner,
               const std::array<unsigned int, 2> &axes,
               const double                       area)
    {
      PieceShape<3> result;
      const double  share = std::min(
        1.,
        area / (planes.width(axes[0], corner[axes[0]]) * planes.width(axes[1], corner[axes[1]])));
      for (unsigned int d = 0; d < 2; ++d)
        for (unsigned int end = 0; end < 2; ++end)
          {
            const unsigned int along       = axes[1 - d];
            const double       width       = planes.width(along, corner[along]);
            result.rims[2 * axes[d] + end] = {share * width,
                                              planes.position(along, corner[along]) + width / 2};
            result.lower_half[axes[d]]     = area / 2;
          }
      return result;
    }


    /// What of a fragment faces fluid and not the inside of another body.
    template <int dim>
    struct Wetted
    {
      double             share = 0; ///< of its area
      dealii::Point<dim> place;     ///< in the fluid, as far off as samples are from each other
    };


    template <int dim>
    Wetted<dim>
    wetted_part(const CutCells<dim>       &cut,
                const SampledRegions<dim> &sampled,
                const GridIndex<dim>      &cell,
                const int                  fragment)
    {
      std::vector<typename SampledRegions<dim>::Simplex> simplices;
      add_simplices(simplices,
                    cut.corners.points,
                    cut.corners.first[fragment],
                    cut.corners.first[fragment + 1]);
      std::vector<dealii::Point<dim>> centres;
      dealii::Tensor<1, dim>          moment, widths;
      for (unsigned int d = 0; d < dim; ++d)
        widths[d] = cut.block.planes().width(d, cell[d]);
      double all = 0, wet = 0;
      for (const auto &simplex : simplices)
        {
          auto         normal = area_vector(simplex);
          const double area   = normal.norm();
          if (!(area > 0))
            continue;
          normal /= area;
          centres.clear();
          add_centres(centres, simplex, n_parts<dim>(simplex, widths));
          for (auto centre : centres)
            {
              const double part = area / centres.size();
              all += part;
              if (!sampled.is_wet(centre, normal))
                continue;
              wet += part;
              for (unsigned int d = 0; d < dim; ++d)
                centre[d] += normal[d] * widths[d] / SampledRegions<dim>::n_along;
              moment += part * (centre - dealii::Point<dim>());
            }
        }
      return wet > 0 ? Wetted<dim>{wet / all, dealii::Point<dim>(moment / wet)} : Wetted<dim>();
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
    dealii::Tensor<1, dim> widths, shifts;

    std::array<unsigned int, dim> axes;
    for (unsigned int d = 0; d < dim; ++d)
      {
        axes[d]   = d;
        shifts[d] = GridPlanes<dim>::shift(index[d]);
        lower[d]  = cut.block.planes().position(d, index[d]);
        widths[d] = cut.block.planes().width(d, index[d]);
      }
    return SampledRegions<dim>(lower, widths, corner_windings(cut, index, axes), shifts, simplices);
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
    const dealii::Tensor<1, 2> shifts(
      {GridPlanes<3>::shift(face.index[axes[0]]), GridPlanes<3>::shift(face.index[axes[1]])});
    const SampledRegions<2> sampled(
      {}, widths, corner_windings(cut, face.index, axes), shifts, simplices);
    for (const auto &region : sampled.regions())
      {
        dealii::Point<3> centroid;
        centroid[face.axis] = planes.position(face.axis, face.index[face.axis]);
        for (unsigned int d = 0; d < 2; ++d)
          centroid[axes[d]] = planes.position(axes[d], face.index[axes[d]]) + region.centroid[d];
        cut.pieces.push_back({static_cast<int>(cut.faces.size()) - 1,
                              region.volume,
                              centroid,
                              {{cut.outside, cut.outside}},
                              mean_shape(planes, face.index, axes, region.volume)});
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
      {
        const auto wetted = wetted_part(cut, sampled, cell.index, f);
        const bool is_dry =
          wetted.share == 0 || static_cast<int>(cut.components.size()) == cell.first_component;
        cut.fragments[f].component = is_dry ? cut.no_component : component(wetted.place);
        cut.fragments[f].area_vector *= wetted.share;
      }
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
