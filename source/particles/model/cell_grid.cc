// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/core/errors.h>
#include <undine/particles/model/cell_grid.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <string>

namespace undine::particles
{
  template <int dim, class Real>
  CellGrid<dim, Real>
  make_cell_grid(const Vector<dim, double> &lower,
                 const Vector<dim, double> &upper,
                 const bool (&periodic)[dim],
                 const double reach)
  {
    CellGrid<dim, Real> grid;
    double              all      = 1;
    constexpr int       too_many = std::numeric_limits<int>::max() / 2;
    for (int axis = 0; axis < dim; ++axis)
      {
        const double size = upper[axis] - lower[axis];
        if (!(size > 0))
          throw InputError("section 'Domain': the box of the particles is empty along axis " +
                           std::to_string(axis) + ".");
        const double cells = std::max(1., std::floor(size / reach * (1 - 1e-6)));
        if (periodic[axis] && cells < 3)
          throw InputError("section 'Domain': the domain is periodic along axis " +
                           std::to_string(axis) +
                           " but shorter than three reaches of a particle. Make it longer or the "
                           "particles smaller.");
        all *= cells;
        if (!(all < too_many))
          throw InputError(
            "section 'Domain': the box of the particles has too many cells. Make it or "
            "'Room beyond open sides' smaller, or the particles larger.");
        grid.lower[axis]        = static_cast<Real>(lower[axis]);
        grid.size[axis]         = static_cast<Real>(size);
        grid.cells[axis]        = static_cast<int>(cells);
        grid.inverse_cell[axis] = static_cast<Real>(cells / size);
        grid.periodic[axis]     = periodic[axis];
      }
    int order[dim]; // fastest axis first
    std::iota(order, order + dim, 0);
    std::stable_sort(
      order, order + dim, [&](const int a, const int b) { return grid.cells[a] < grid.cells[b]; });
    grid.along = order[0];
    for (int k = 0, stride = 1; k < dim; stride *= grid.cells[order[k]], ++k)
      grid.strides[order[k]] = stride;
    return grid;
  }

#define INSTANTIATE(dim, Real)                            \
  template CellGrid<dim, Real> make_cell_grid<dim, Real>( \
    const Vector<dim, double> &, const Vector<dim, double> &, const bool(&)[dim], double);
  INSTANTIATE(2, float)
  INSTANTIATE(2, double)
  INSTANTIATE(3, float)
  INSTANTIATE(3, double)
#undef INSTANTIATE
} // namespace undine::particles
