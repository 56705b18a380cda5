// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_fluid_pressure_gradient_h
#define undine_fluid_pressure_gradient_h

#include <undine/fluid/fluid_model.h>
#include <undine/fluid/fluid_quantities.h>
#include <undine/fluid/pressure_numbers.h>

#include <algorithm>
#include <vector>

namespace undine
{
  /// The two adjoint operators between faces and cells, and what openings add to them. Faces on
  /// walls and inflows are held: D sees their velocity, pressure does not accelerate them.
  /// @{

  /// A face of this rank on a side of the domain.
  template <int dim>
  struct SideFace
  {
    Side           side;
    GridIndex<dim> face;
    GridIndex<dim> cell;  ///< the one inside
    int            piece; ///< of a divided face: which one; else -1
  };

  /// action(SideFace, place) for all of them. `open_parts`: what bodies leave of the grid; nullptr:
  /// everything.
  template <int dim, class Action>
  void
  for_each_side_face(const FluidModel<dim> &model,
                     const OpenParts<dim>  *open_parts,
                     const Action          &action)
  {
    for (unsigned int axis = 0; axis < dim; ++axis)
      for (unsigned int end = 0; end < 2 && !model.grid().periodic(axis); ++end)
        {
          const int   plane   = end == 0 ? 0 : model.grid().cells_along()[axis];
          const auto &lattice = *model.grid().faces(axis);
          auto        layer   = lattice.owned();
          layer.lower[axis]   = std::max(layer.lower[axis], plane);
          layer.upper[axis]   = std::min(layer.upper[axis], plane + 1);
          for_each(layer, [&](const GridIndex<dim> &face) {
            const auto  cell    = end == 0 ? face : moved<dim>(face, axis, -1);
            const auto *divided = open_parts ? &open_parts->faces[axis] : nullptr;
            if (!divided || divided->kind(face) == LatticeParts<dim>::Kind::whole)
              action(SideFace<dim>{{axis, end}, face, cell, -1}, lattice.point(face));
            else
              for_each_part(*divided, face, [&](const int piece) {
                action(SideFace<dim>{{axis, end}, face, cell, piece}, divided->all()[piece].place);
              });
          });
        }
  }

  /// a n along the axis [m^(dim-1)].
  template <int dim>
  double
  signed_area(const MacGrid<dim>   &grid,
              const OpenParts<dim> *open_parts,
              const SideFace<dim>  &face);

  /// The velocity along the axis [m/s].
  template <int dim>
  double
  value_on(const Velocity<dim> &velocity, const SideFace<dim> &face);

  /// a v.n [m^dim/s].
  template <int dim>
  double
  outward_flux(const MacGrid<dim> &grid, const Velocity<dim> &velocity, const SideFace<dim> &face);

  /// One through which fluid may leave or enter freely.
  template <int dim>
  struct OpenFace : SideFace<dim>
  {
    double       pressure; ///< reduced pressure on the face [Pa]
    BoundaryKind kind;     ///< outflow or pressure
    double       entering; ///< how fast fluid enters through it, if at all [m/s]
    double mobility = 1;   ///< share of an acceleration that is left, see hold_back_entering_flow()
  };

  /// The openings of this rank with their pressures at `time`. Where fluid enters through an
  /// outflow, p = -rho (v.n)^2 / 2, so that it brings in no energy (directional do-nothing
  /// condition, Braack & Mucha 2014); how that acts in a step: hold_back_entering_flow().
  /// `open_parts`: what bodies leave of the grid, which may have changed since `velocity`; nullptr:
  /// everything.
  template <int dim>
  std::vector<OpenFace<dim>>
  open_faces(const FluidModel<dim> &model,
             const Velocity<dim>   &velocity,
             const OpenParts<dim>  *open_parts,
             const double           time);

  /// Where the pressure next to a side is.
  template <int dim>
  PressurePlace<dim>
  place_inside(const OpenParts<dim> *open_parts, const SideFace<dim> &face);

  /// (D v)_c = sum_f +-a_f v_f over the faces of every owned cell, or over the pieces of faces
  /// around every component: the volume that leaves it, [m^dim/s]; zero in bodies. One ghost layer
  /// of the velocity must be up to date.
  template <int dim>
  Field<dim>
  divergence(const FluidModel<dim> &model, const Velocity<dim> &velocity);

  /// (rho V)^-1 D^T p on the owned faces, zero on held ones, [m/s^2]: the acceleration by the
  /// pressure, minus grad p / rho. One ghost layer of the pressure must be up to date.
  template <int dim>
  Velocity<dim>
  pressure_acceleration(const FluidModel<dim>            &model,
                        const Field<dim>                 &pressure,
                        const std::vector<OpenFace<dim>> &openings);

  /// a_f^2 / (rho V_f), the entry that a whole face contributes to L = D (rho V)^-1 D^T.
  template <int dim>
  double
  pressure_coupling(const FluidModel<dim> &model,
                    const unsigned int     axis,
                    const GridIndex<dim>  &face);
  /// @}

  /// Give divided points the mean of their parts, see LatticeParts; closed ones get zero. @{
  template <int dim>
  void
  set_means(Field<dim> &field, const MacGrid<dim> &grid);

  template <int dim>
  void
  set_means(Velocity<dim> &velocity, const MacGrid<dim> &grid);
  /// @}

  /// Volume of the fluid in every owned cell and component [m^dim].
  template <int dim>
  void
  set_volumes(Field<dim> &volumes, const MacGrid<dim> &grid);

  /// field += factor * change on owned points and all parts.
  template <int dim>
  void
  add(Field<dim> &field, const double factor, const Field<dim> &change);

  /// velocity += factor * acceleration on owned faces and pieces.
  template <int dim>
  void
  add(Velocity<dim> &velocity, const double factor, const Velocity<dim> &acceleration);

  /// Exchange one ghost layer of each component.
  template <int dim>
  void
  exchange(Velocity<dim> &velocity);
} // namespace undine

#endif
