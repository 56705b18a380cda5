// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_particles_setup_make_constants_h
#define undine_particles_setup_make_constants_h

#include <undine/particles/boundaries/open_boundaries.h>
#include <undine/particles/model/constants.h>
#include <undine/particles/model/step_control.h>
#include <undine/particles/setup/setup.h>

namespace undine::particles
{
  /// What passes need to know of a scene but for Constants::bodies. Throws InputError if its box
  /// does not hold a cell.
  template <int dim, class Real>
  Constants<dim, Real>
  make_constants(const Setup<dim> &setup);

  /// Throws InputError if there are too many.
  template <int dim, class Real>
  OpenBoundaries<dim, Real>
  make_open_boundaries(const Setup<dim> &setup);

  /// What pressures of a state lack where fluid fills its domain: that of the fluid at rest at x
  /// (P11) [Pa]. Else zero.
  template <int dim>
  double
  pressure_at_rest(const Setup<dim> &setup, const Vector<dim, double> &x);

  /// lambda + 2 mu / dim [Pa]; in 2D of plane strain.
  double
  bulk_modulus(const BodySetup &body, int dim);

  /// Bounds on the sub-steps of a frame [s]. `elastic_rate` is c_p / l0 of the fastest body [1/s].
  template <int dim>
  StepBounds
  make_bounds(const Setup<dim> &setup, double elastic_rate);
} // namespace undine::particles

#endif
