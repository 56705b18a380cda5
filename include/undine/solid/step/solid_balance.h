// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_solid_step_solid_balance_h
#define undine_solid_step_solid_balance_h

#include <deal.II/base/tensor.h>

#include <map>
#include <string>

namespace undine
{
  /// The balance of the bodies' energy and momentum over a step, each term from its own formula.
  /// With dd = d^{n+1} - d^n, the terms of StageCoefficients and W = sum_e w_e,
  ///
  ///     kinetic + elastic = loads + nodal + supports + contact - damping
  ///                         - inertia_loss - elastic_loss
  ///
  ///     momentum = h (loads_force + damping_force + supports_force + contact_force
  ///                   + nodal forces) - inertia_gap
  ///
  /// up to the tolerance of Newton's method and to rounding. Where an integrator averages forces
  /// over other times (W < 1) the rest of them is in inertia_loss and inertia_gap.
  template <int dim>
  struct SolidBalance
  {
    double kinetic      = 0; ///< gain of u.M u/2 [J]
    double elastic      = 0; ///< gain of int W dX [J]
    double loads        = 0; ///< dead loads and follower pressures / W times dd [J]
    double nodal        = 0; ///< given nodal forces times dd [J]
    double supports     = 0; ///< forces at fixed degrees of freedom times dd [J]
    double damping      = 0; ///< h times RayleighDamping::power() [J]
    double contact      = 0; ///< forces of contact times dd [J]
    double inertia_loss = 0; ///< the integrator's: M (m u + ...).dd - kinetic [J], and the rest
    double elastic_loss = 0; ///< the integrator's: sum_e w_e K(d_e).dd - int K(d).dd [J]

    /// The contribution of each effect to the loads, by its own force [J].
    std::map<std::string, double> loads_by_effect;

    double contact_energy = 0; ///< gain of the potential of contact, from the stage's begin [J]

    double elastic_work      = 0; ///< sum_e w_e K(d_e).dd [J]
    double damping_on_path   = 0; ///< in inertia_loss: forces of damping times dd / W - damping [J]
    double inertia_on_path   = 0; ///< in inertia_loss: M (m u + ...).(dd - h u) [J]
    double contact_handed_on = 0; ///< u.M u_c, u_c being no rate that later stages use [J]
    double energy_rounding   = 0; ///< what rounding leaves of energies [J]
    double force_rounding    = 0; ///< and of forces [N]

    dealii::Tensor<1, dim> momentum;    ///< gain of sum M u [kg m/s]
    dealii::Tensor<1, dim> inertia_gap; ///< h sum M (m u + ...) - momentum, and the rest [kg m/s]
    dealii::Tensor<1, dim> loads_force; ///< [N]
    dealii::Tensor<1, dim> supports_force;  ///< [N]
    dealii::Tensor<1, dim> damping_force;   ///< [N]
    dealii::Tensor<1, dim> contact_force;   ///< [N]
    dealii::Tensor<1, dim> contact_impulse; ///< sum M u_c [kg m/s]
  };

  /// Energy and momentum of all bodies.
  template <int dim>
  struct SolidAmounts
  {
    double                 kinetic = 0; ///< u.M u/2 [J]
    double                 elastic = 0; ///< int W dX [J]
    dealii::Tensor<1, dim> momentum;    ///< sum M u [kg m/s]

    double
    energy() const
    {
      return kinetic + elastic;
    }
  };
} // namespace undine

#endif
