// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/cutting/cut_cells.h>

namespace undine
{
  template <int dim>
  void
  CutCells<dim>::clear()
  {
    cells.clear();
    components.clear();
    faces.clear();
    pieces.clear();
    fragments.clear();
    corners.first.assign(1, 0);
    corners.points.clear();
    counts = {};
    cell_slots.clear();
    face_slots.clear();
  }


  template struct CutCells<2>;
  template struct CutCells<3>;
} // namespace undine
