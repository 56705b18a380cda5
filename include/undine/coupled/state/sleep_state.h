// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_coupled_state_sleep_state_h
#define undine_coupled_state_sleep_state_h

#include <deal.II/base/tensor.h>

#include <algorithm>
#include <vector>

namespace undine
{
  /// Which bodies sleep (SleepingBodies), the same on all ranks. Empty where none may.
  template <int dim>
  struct SleepState
  {
    /// True if bodies may sleep.
    bool
    in_use() const
    {
      return !asleep.empty();
    }

    /// Does any body sleep?
    bool
    any_asleep() const
    {
      return std::find(asleep.begin(), asleep.end(), true) != asleep.end();
    }

    /// The body is awake, and its time at rest begins anew.
    void
    wake(const unsigned int body)
    {
      asleep[body]     = false;
      slow_time[body]  = 0;
      unbalanced[body] = unknown;
    }

    /// wake() all bodies.
    void
    wake_all()
    {
      for (unsigned int body = 0; body < asleep.size(); ++body)
        wake(body);
    }

    /// Wake those that are awake in `other`. False if all of them have been.
    bool
    wake_with(const SleepState &other)
    {
      bool any = false;
      for (unsigned int body = 0; body < asleep.size(); ++body)
        if (asleep[body] && !other.asleep[body])
          {
            wake(body);
            any = true;
          }
      return any;
    }

    static constexpr double unknown = -1;

    bool settled     = true;       ///< false: some that sleep still have a velocity
    bool begins_anew = false;      ///< the next step, without rates of the last one: some that fell
                                   ///< asleep in it were in contact
    std::vector<bool>   asleep;    ///< [body]
    std::vector<double> slow_time; ///< [body] for how long it has been slow without a break [s]

    /// Loads of fluid and contact in the nodes of the bodies' surfaces, of those that sleep when
    /// they fell asleep [N]; empty where nothing acts on surfaces.
    std::vector<dealii::Tensor<1, dim>> loads;

    /// [body] Sum over the nodes of what other loads and stresses leave to fluid, contact and
    /// supports, when it fell asleep [N]; `unknown` of those that are awake.
    std::vector<double> unbalanced;
  };
} // namespace undine

#endif
