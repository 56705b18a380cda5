// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/cutting/closure_defect.h>

#include <algorithm>
#include <cmath>

namespace undine
{
  template <int dim>
  double
  closure_defect(CutWorkspace<dim> &work, const CutCells<dim> &cut)
  {
    const auto &cell = cut.cells.back();
    auto       &sums = work.closure;
    sums.assign(cut.components.size() - cell.first_component, dealii::Tensor<1, dim>());
    for (int f = cell.first_fragment; f < static_cast<int>(cut.fragments.size()); ++f)
      sums[cut.fragments[f].component - cell.first_component] += cut.fragments[f].area_vector;
    dealii::Tensor<1, dim> areas;
    for (unsigned int axis = 0; axis < dim; ++axis)
      {
        areas[axis] = cut.block.face_area(axis, cell.index);
        for (const int end : {0, 1})
          {
            const int face = cut.face_slots.find(cut.block.key(moved(cell.index, axis, end), axis));
            for (int p = cut.faces[face].first_piece; p < work.face_records[face].end_piece; ++p)
              sums[cut.pieces[p].components[1 - end] - cell.first_component][axis] +=
                end == 0 ? -cut.pieces[p].area : cut.pieces[p].area;
          }
      }
    double worst = 0;
    for (const auto &sum : sums)
      for (unsigned int d = 0; d < dim; ++d)
        worst = std::max(worst, std::abs(sum[d]) / areas[d]);
    return worst;
  }


  template double
  closure_defect(CutWorkspace<2> &, const CutCells<2> &);
  template double
  closure_defect(CutWorkspace<3> &, const CutCells<3> &);
} // namespace undine
