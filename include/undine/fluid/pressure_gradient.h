// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_fluid_pressure_gradient_h
#define undine_fluid_pressure_gradient_h

#include <undine/fluid/fluid_model.h>
#include <undine/fluid/fluid_quantities.h>

#include <vector>

namespace undine
{
  /// The two adjoint operators between faces and cells, and what openings add to them. Faces on
  /// walls and inflows are held: D sees their velocity, pressure does not accelerate them.
  /// @{

  /// A face of this rank through which fluid may leave or enter freely.
  template <int dim>
  struct OpenFace
  {
    Side           side;
    GridIndex<dim> face;
    GridIndex<dim> cell;     ///< the one inside
    double         pressure; ///< reduced pressure on the face [Pa]
  };

  /// The openings of this rank with their pressures at `time`. Where fluid enters through an
  /// outflow, p = -rho (v.n)^2 / 2, so that it brings in no energy and cannot blow up (directional
  /// do-nothing condition, Braack & Mucha 2014).
  template <int dim>
  std::vector<OpenFace<dim>>
  open_faces(const FluidModel<dim> &model, const Velocity<dim> &velocity, const double time);

  /// (D v)_c = sum_f +-a_f v_f over the faces of every owned cell, in the order of
  /// Field::owned_values(): the volume that leaves it, [m^dim/s]. One ghost layer of the velocity
  /// must be up to date.
  template <int dim>
  std::vector<double>
  divergence(const FluidModel<dim> &model, const Velocity<dim> &velocity);

  /// (rho V)^-1 D^T p on the owned faces, zero on held ones, [m/s^2]: the acceleration by the
  /// pressure, minus grad p / rho. One ghost layer of the pressure must be up to date.
  template <int dim>
  Velocity<dim>
  pressure_acceleration(const FluidModel<dim>            &model,
                        const Field<dim>                 &pressure,
                        const std::vector<OpenFace<dim>> &openings);

  /// a_f^2 / (rho V_f), the entry that a face contributes to L = D (rho V)^-1 D^T.
  template <int dim>
  double
  pressure_coupling(const FluidModel<dim> &model,
                    const unsigned int     axis,
                    const GridIndex<dim>  &face);
  /// @}

  /// velocity += factor * acceleration on owned faces.
  template <int dim>
  void
  add(Velocity<dim> &velocity, const double factor, const Velocity<dim> &acceleration);

  /// Exchange one ghost layer of each component.
  template <int dim>
  void
  exchange(Velocity<dim> &velocity);
} // namespace undine

#endif
