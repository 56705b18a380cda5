// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_fluid_pressure_pressure_gradient_h
#define undine_fluid_pressure_pressure_gradient_h

#include <undine/fluid/boundary/side_faces.h>
#include <undine/fluid/model/fluid_model.h>

#include <vector>

namespace undine
{
  /// The acceleration of the faces' velocities by pressure (F3): the adjoint of divergence(), and
  /// the contribution of openings. Faces on walls and inflows have a given velocity, which counts
  /// in D v; pressure does not accelerate them. @{

  /// One through which fluid may leave or enter freely.
  template <int dim>
  struct OpenFace : SideFace<dim>
  {
    double       outside;      ///< reduced pressure that is given [Pa]
    double       pressure;     ///< reduced pressure on the face [Pa]
    BoundaryKind kind;         ///< outflow or pressure
    double       entering;     ///< speed of the backflow through it, max(0, -v.n) [m/s]
    double       mobility = 1; ///< share of an acceleration that is left, see stabilise_backflow()
  };

  /// The openings of this rank with their pressures at `time`. Where there is backflow through an
  /// outflow, p is less by rho (v.n)^2 / 2, so that it brings in no energy beyond that of fluid at
  /// rest outside (directional do-nothing condition, Braack & Mucha 2014); how that acts in a step:
  /// stabilise_backflow(). `topology`: of the fluid, which may differ from that of `velocity`;
  /// nullptr: nothing is cut.
  template <int dim>
  std::vector<OpenFace<dim>>
  open_faces(const FluidModel<dim>    &model,
             const Velocity<dim>      &velocity,
             const FluidTopology<dim> *topology,
             const double              time);

  /// (rho V)^-1 D^T p on the owned faces, zero on those with a given velocity [m/s^2]: the
  /// acceleration by the pressure, minus grad p / rho. One ghost layer of the pressure must be up
  /// to date.
  template <int dim>
  Velocity<dim>
  pressure_acceleration(const FluidModel<dim>            &model,
                        const Field<dim>                 &pressure,
                        const std::vector<OpenFace<dim>> &openings);

  /// a_f^2 / (rho V_f), the entry that a whole face contributes to L = D (rho V)^-1 D^T (F4).
  template <int dim>
  double
  pressure_coupling(const FluidModel<dim> &model,
                    const unsigned int     axis,
                    const GridIndex<dim>  &face);
  /// @}
} // namespace undine

#endif
