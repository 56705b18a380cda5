// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_cutting_whole_facets_h
#define undine_cutting_whole_facets_h

#include <undine/cutting/cut_cells.h>
#include <undine/surface/united_surface.h>

#include <vector>

namespace undine
{
  /// Cells were cut by a united surface: let fragments refer to the facets of which its facets are
  /// `parts`, with means in the barycentric coordinates of these.
  template <int dim>
  void
  refer_to_whole_facets(CutCells<dim> &cut, const std::vector<FacetPart<dim>> &parts);
} // namespace undine

#endif
