// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_cutting_closure_defect_h
#define undine_cutting_closure_defect_h

#include <undine/cutting/cut_workspace.h>

namespace undine
{
  /// Largest |sum a n + sum N| of the components of the last cell, each direction relative to the
  /// area of a face normal to it.
  template <int dim>
  double
  closure_defect(CutWorkspace<dim> &work, const CutCells<dim> &cut);
} // namespace undine

#endif
