// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/contact/domain_walls.h>

namespace undine
{
  namespace
  {
    /// Calls action(boundary) for all faces of the side.
    template <int dim, class Action>
    void
    for_each_boundary_face(const FluidModel<dim> &fluid, const Side side, const Action &action)
    {
      const auto    &along = fluid.grid().cells_along();
      GridIndex<dim> cell{};
      for (unsigned int axis = 0; axis < dim;)
        {
          action(fluid.boundaries().at(side, cell));
          axis = 0;
          while (axis < dim && (axis == side.axis || ++cell[axis] == along[axis]))
            cell[axis++] = 0;
        }
    }
  } // namespace


  template <int dim>
  std::vector<DomainWall<dim>>
  domain_walls(const FluidModel<dim> &fluid)
  {
    std::vector<DomainWall<dim>> result;
    for (unsigned int axis = 0; axis < dim; ++axis)
      for (unsigned int end = 0; end < 2 && !fluid.grid().periodic(axis); ++end)
        {
          const Side side{axis, end};
          bool       opens = false, closes = false;
          for_each_boundary_face(fluid, side, [&](const Boundary<dim> &boundary) {
            (boundary.lets_fluid_pass() ? opens : closes) = true;
          });
          if (!closes)
            continue;
          ContactWall<dim> plane;
          plane.name         = side_names()[side.number()];
          plane.point        = end == 0 ? fluid.grid().lower() : fluid.grid().upper();
          plane.normal[axis] = -side.sign();
          result.push_back({side, plane, !opens});
        }
    return result;
  }


  template std::vector<DomainWall<2>>
  domain_walls(const FluidModel<2> &);
  template std::vector<DomainWall<3>>
  domain_walls(const FluidModel<3> &);
} // namespace undine
