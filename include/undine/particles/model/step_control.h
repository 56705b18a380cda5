// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_particles_model_step_control_h
#define undine_particles_model_step_control_h

#include <undine/particles/execution/atomics.h>
#include <undine/particles/math/vector.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace undine::particles
{
  /// What may bound a sub-step.
  enum class Bound
  {
    asked,     ///< the largest sub-step that the scene allows, or the frame
    speed,     ///< nothing may cross more than a share of the spacing
    waves,     ///< nor may gravity waves, or what falls from rest
    viscosity, ///< explicit friction
    count
  };

  /// What may have gone wrong in a frame, as bits.
  enum class Failure : unsigned int
  {
    not_a_number   = 1,  ///< a speed is
    neighbours     = 2,  ///< a particle has more neighbours than the list can hold
    outside        = 4,  ///< a particle left the box
    matrix_indices = 8,  ///< neighbours are too far apart in memory for packed matrix entries
    no_reserve     = 16, ///< more particles flow in than wait to
    crushed        = 32  ///< a body became so stiff that its explicit steps are too many
  };

  /// Bounds on sub-steps [s], constant.
  struct StepBounds
  {
    double asked       = 0; ///< largest
    double waves       = 0; ///< share of l0 / sqrt(g H), or of a fall from rest; 0: none
    double viscosity   = 0; ///< share of l0^2 / nu; 0: none
    double speed_share = 0; ///< of l0 that the fastest particle may cross [m]
    /// c_p / l0 of the fastest body at rest, more with damping [1/s]; 0: no bodies.
    double elastic_rate    = 0;
    double elastic_share   = 0; ///< of 1 over that rate, for an explicit step of bodies [1]
    int most_elastic_steps = 0; ///< explicit ones in a sub-step; else one implicit; 0: any number
  };

  /// How a solver did in a frame.
  struct SolverRecord
  {
    unsigned int iterations      = 0;
    unsigned int most_iterations = 0; ///< in one sub-step
    unsigned int not_converged   = 0; ///< sub-steps that ended above the tolerance
    double       worst_residual  = 0; ///< relative
  };


  /// The sub-steps of a frame choose themselves, so that the device need not wait for the host: all
  /// passes read the step from here. After the end of the frame `dt` is zero and they do nothing.
  struct StepControl
  {
    double frame   = 0; ///< length of the frame [s]
    double elapsed = 0; ///< of it at the end of the present sub-step [s]
    double dt      = 0; ///< present sub-step [s]

    double shortening = 1; ///< how many times as short sub-steps are as bounds allow

    std::uint32_t largest_speed = 0; ///< in the last sub-step, bits of a float [m/s]
    /// As in StepBounds, of deformed bodies, bits of floats: of this explicit step and the next.
    std::uint32_t elastic_rates[2] = {};
    unsigned int  failures         = 0; ///< bits of Failure

    unsigned int sub_steps                                  = 0; ///< in this frame so far
    unsigned int bounded_by[static_cast<int>(Bound::count)] = {};
    unsigned int elastic_steps_total                        = 0;
    double       smallest_dt                                = 0; ///< [s]
    double       fastest                                    = 0; ///< [m/s]
    double       volume_error                               = 0; ///< of MeasureVolumeError [1]
    SolverRecord pressure, faces;

    UNDINE_HOST_DEVICE
    bool
    done() const
    {
      return dt <= 0;
    }

    /// How many sub-steps like the present one the rest of the frame takes, at most `most`.
    int
    sub_steps_left(const int most) const
    {
      if (!(dt > 0))
        return 0;
      const double left = std::ceil((frame - elapsed) / dt - 1e-6);
      return static_cast<int>(std::min(left, static_cast<double>(most)));
    }
  };

  /// Chooses the next sub-step; run for one index.
  struct ChooseStep
  {
    StepControl *control;
    StepBounds   bounds;

    UNDINE_HOST_DEVICE
    void
    operator()(const int) const
    {
      StepControl &c     = *control;
      const double left  = c.frame - c.elapsed;
      const double speed = number_of_bits(c.largest_speed);
      if (!(speed < 1e30))
        c.failures |= static_cast<unsigned int>(Failure::not_a_number);
      c.fastest = maximum(c.fastest, speed);
      if (left <= 1e-9 * c.frame || c.failures != 0)
        {
          c.dt = 0;
          return;
        }
      Bound        bound = Bound::asked;
      const double dt    = minimum(largest(speed, bound), c.frame) / c.shortening;
      const double parts = ceil(left / dt * (1 - 1e-9)); // equal parts land on the frame's end
      c.dt               = parts > 1 ? left / parts : left;
      c.elapsed          = parts > 1 ? c.elapsed + c.dt : c.frame;
      c.smallest_dt      = c.sub_steps == 0 ? c.dt : minimum(c.smallest_dt, c.dt);
      c.largest_speed    = 0;
      ++c.bounded_by[static_cast<int>(bound)];
      ++c.sub_steps;
    }

  private:
    UNDINE_HOST_DEVICE
    double
    largest(const double speed, Bound &bound) const
    {
      double dt = bounds.asked;
      lower(dt, bound, bounds.waves, Bound::waves);
      lower(dt, bound, bounds.viscosity, Bound::viscosity);
      if (speed > 0)
        lower(dt, bound, bounds.speed_share / speed, Bound::speed);
      return dt;
    }

    UNDINE_HOST_DEVICE
    static void
    lower(double &dt, Bound &bound, const double candidate, const Bound name)
    {
      if (candidate > 0 && candidate < dt)
        {
          dt    = candidate;
          bound = name;
        }
    }
  };
} // namespace undine::particles

#endif
