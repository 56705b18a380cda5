// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/cutting/cut_block.h>
#include <undine/cutting/cut_flags.h>

#include <algorithm>

namespace undine
{
  namespace
  {
    /// What surrounds a component of a sampled cell.
    template <int dim>
    struct Outline
    {
      dealii::Tensor<1, dim> openings;      ///< sum of the pieces' area vectors, out of it
      double                 aperture = 0;  ///< sum of their areas
      dealii::Tensor<1, dim> walls;         ///< sum of the fragments' area vectors
      double                 wall_area = 0; ///< sum of their areas
      double                 excess    = 0; ///< sum of |excess()|

      /// What a fragment contributes to the flux beyond its share of all fragments.
      dealii::Tensor<1, dim>
      excess_of(const dealii::Tensor<1, dim> &area_vector) const
      {
        return area_vector - area_vector.norm() / wall_area * walls;
      }

      /// Its contribution afterwards: shares close, and excess can leave through the pieces.
      dealii::Tensor<1, dim>
      closing(const dealii::Tensor<1, dim> &area_vector) const
      {
        const double factor = excess > aperture ? aperture / excess : 1.;
        return factor * excess_of(area_vector) - area_vector.norm() / wall_area * openings;
      }
    };


    template <int dim>
    bool
    is_sampled(const CutCells<dim> &cut, const int component)
    {
      return component >= 0 &&
             (cut.cells[cut.components[component].cell].flags & cut_needs_sampling) != 0;
    }
  } // namespace


  template <int dim>
  void
  close_sampled_cells(CutCells<dim> &cut)
  {
    if (cut.counts.sampled_cells == 0)
      return;
    std::vector<Outline<dim>> outlines(cut.components.size());
    for (const auto &piece : cut.pieces)
      for (const int end : {0, 1})
        if (const int c = piece.components[end]; is_sampled(cut, c))
          {
            outlines[c].openings[cut.faces[piece.face].axis] += end == 0 ? piece.area : -piece.area;
            outlines[c].aperture += std::abs(piece.area);
          }
    const auto for_each_wall = [&](const auto &action) {
      for (auto &fragment : cut.fragments)
        if (is_sampled(cut, fragment.component) && fragment.area_vector.norm() > 0)
          action(fragment.area_vector, outlines[fragment.component]);
    };
    for_each_wall([](const auto &area_vector, auto &outline) {
      outline.walls += area_vector;
      outline.wall_area += area_vector.norm();
    });
    for_each_wall([](const auto &area_vector, auto &outline) {
      outline.excess += outline.excess_of(area_vector).norm();
    });
    for_each_wall(
      [](auto &area_vector, auto &outline) { area_vector = outline.closing(area_vector); });
  }


  template void
  close_sampled_cells(CutCells<2> &);
  template void
  close_sampled_cells(CutCells<3> &);
} // namespace undine
