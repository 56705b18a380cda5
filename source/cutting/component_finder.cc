// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/cutting/component_finder.h>

#include <cmath>

namespace undine
{
  template <int dim>
  void
  PartSums<dim>::include(const dealii::Point<dim> &place)
  {
    if (empty)
      lower = upper = place;
    empty = false;
    for (unsigned int d = 0; d < dim; ++d)
      {
        lower[d] = std::min(lower[d], place[d]);
        upper[d] = std::max(upper[d], place[d]);
      }
  }


  template <int dim>
  void
  PartSums<dim>::add(const PartSums &other)
  {
    volume += other.volume;
    moment += other.moment;
    if (!other.empty)
      {
        include(other.lower);
        include(other.upper);
      }
  }


  template <int dim>
  dealii::Point<dim>
  PartSums<dim>::centroid() const
  {
    dealii::Point<dim> result;
    for (unsigned int d = 0; d < dim; ++d)
      result[d] = volume != 0 ? std::clamp(moment[d] / volume, lower[d], upper[d])
                              : (lower[d] + upper[d]) / 2;
    return result;
  }


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


  template struct PartSums<2>;
  template struct PartSums<3>;
  template double
  closure_defect(CutWorkspace<2> &, const CutCells<2> &);
  template double
  closure_defect(CutWorkspace<3> &, const CutCells<3> &);
} // namespace undine
