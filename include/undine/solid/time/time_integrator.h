// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_solid_time_time_integrator_h
#define undine_solid_time_time_integrator_h

#include <undine/base/core/stage.h>
#include <undine/base/options/options.h>

#include <memory>
#include <vector>

namespace undine
{
  /// A stage of h [s] from t^n (T1), written for the one unknown u = u^{n+1} [m/s]:
  ///
  ///     M (m u + m_u u^n + m_a a^n) + alpha M u_C + eta W V(d_V) u_V
  ///       + sum_e w_e [ K(d_e) - f(d_e, t_e) ] - kappa f_c + (kappa - 1) f_c^b - J p = 0       [N]
  ///     u_C = c u + c_u u^n
  ///     d_e = (1 - s_e) d^n + s_e d^{n+1},   t_e = t^n + s_e h
  ///     d^{n+1} = d^n + e_u u^n + e_a a^n + e u
  ///     a^{n+1} = b u + b_u u^n + b_a a^n
  ///
  /// where f are gravity, dead loads and follower pressures, f_c forces of contact, f_c^b those
  /// of the stage before (SolidState::contact_forces), and kappa is ContactStart::weight. Unless
  /// the step is static, m = 1/h and m_u = -1/h: the impulse h J p of a fluid's pressure enters the
  /// momentum once and un-averaged, whatever the integrator. alpha and eta are those of Rayleigh
  /// damping, whose viscosity V (S15) has no negative eigenvalue.
  struct StageCoefficients
  {
    /// Internal forces and loads between t^n (position 0) and t^{n+1} (position 1).
    struct TimeLevel
    {
      double weight;   ///< w_e [1]
      double position; ///< s_e [1]
    };

    double                 mass                  = 0; ///< m [1/s]
    double                 mass_old_velocity     = 0; ///< m_u [1/s]
    double                 mass_old_acceleration = 0; ///< m_a [1]
    double                 damping               = 0; ///< c [1]
    double                 damping_old_velocity  = 0; ///< c_u [1]
    std::vector<TimeLevel> levels;
    double                 displacement              = 0; ///< e [s]
    double                 displacement_velocity     = 0; ///< e_u [s]
    double                 displacement_acceleration = 0; ///< e_a [s^2]
    double                 acceleration              = 0; ///< b [1/s]
    double                 acceleration_velocity     = 0; ///< b_u [1/s]
    double                 acceleration_acceleration = 0; ///< b_a [1]

    /// Sum of the levels' weights [1]: reactions are divided by it and, where energy and momentum
    /// are accounted for, loads and damping.
    double
    sum_of_weights() const;
  };

  /// The accuracy of a method: it turns a free oscillation exp(i w t) into exp(i w (1 + e) t) with
  /// |e| = C (w h)^p to the leading order. The error of one step is C h^(p+1) |y^(p+1)|.
  struct TimeAccuracy
  {
    unsigned int order;    ///< p
    double       constant; ///< C [1]
  };

  /// Are the rates with which everything changes known where a step begins? In the first step of a
  /// run they are not.
  enum class RatesAtBegin
  {
    unknown,
    known
  };

  /// A method to advance the bodies in time. One integrator is one .cc file that registers itself.
  class TimeIntegrator
  {
  public:
    virtual ~TimeIntegrator() = default;

    /// Declare and read the keys of this integrator.
    virtual void
    add_options(const Options &options) = 0;

    /// The stages of a step of `dt` [s]. A single one unless the integrator has more.
    virtual Stages
    stages(double dt, RatesAtBegin rates) const;

    /// The coefficients of a stage of `dt` [s].
    virtual StageCoefficients
    coefficients(double dt) const = 0;

    /// False if it leaves out inertia, so that bodies have no kinetic energy.
    bool
    has_inertia() const
    {
      return coefficients(1.).mass != 0;
    }

    /// Order and constant of the error in time.
    virtual TimeAccuracy
    accuracy() const = 0;

    /// True if a^0 has to be the acceleration that the loads at t = 0 give.
    virtual bool
    uses_acceleration() const;

    /// The same number for integrators that can go on with what others have left of rates and
    /// accelerations.
    unsigned int
    kind_of_rates() const;

    /// Where a motion is prescribed, a^{n+1} is its acceleration at the time to which the
    /// integrator's a belongs, t^{n+1} + shift h; returns the shift [1].
    virtual double
    acceleration_shift() const;
  };

  /// The one that section `Time` of the scene chooses.
  std::unique_ptr<TimeIntegrator>
  choose_time_integrator(const Options &scene);
} // namespace undine

#endif
