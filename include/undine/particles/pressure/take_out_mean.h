// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_particles_pressure_take_out_mean_h
#define undine_particles_pressure_take_out_mean_h

#include <undine/particles/execution/sums.h>
#include <undine/particles/model/particle.h>
#include <undine/particles/model/step_control.h>
#include <undine/particles/pressure/conjugate_gradients.h>

namespace undine::particles
{
  /// What sums to zero afterwards: all rows, by a change of the fluid's; or those of the fluid, by
  /// a change of all.
  enum class MeanOf
  {
    right_hand_side,
    solution
  };

  /// In a full domain the systems of pressures and of the faces' potentials have constants for
  /// null space: right-hand sides must sum to zero (P12), and constants in solutions mean nothing.
  /// One launch.
  template <int dim, class Real, class Value>
  struct TakeOutMean
  {
    using Stored = typename Components<Value>::Stored;

    MeanOf                  of;
    int                     n;
    const Place<dim, Real> *places;
    const int              *is_unknown;
    Stored                 *values;
    const StepControl      *control;

    template <class Team>
    UNDINE_HOST_DEVICE
    void
    operator()(Team &team) const
    {
      if (control->done())
        return;
      constexpr int count = Components<Value>::count;
      const auto    sums  = team.template sum<count + 1>(n, [&](const int i, Sums<count + 1> &add) {
        const bool is_of_fluid = is_fluid(i);
        if (!is_unknown[i] || (of == MeanOf::solution && !is_of_fluid))
          return;
        Value value = values[i];
        for (int k = 0; k < count; ++k)
          add[k] += Components<Value>::of(value, k);
        add[count] += is_of_fluid ? 1 : 0;
      });
      if (!(sums[count] > 0))
        return;
      team.for_each(n, [&](const int i) {
        if (!is_unknown[i] || (of == MeanOf::right_hand_side && !is_fluid(i)))
          return;
        Value value = values[i];
        for (int k = 0; k < count; ++k)
          Components<Value>::of(value, k) -= static_cast<Real>(sums[k] / sums[count]);
        values[i] = value;
      });
    }

  private:
    UNDINE_HOST_DEVICE
    bool
    is_fluid(const int i) const
    {
      return places[i].tag.kind() == Kind::fluid;
    }
  };
} // namespace undine::particles

#endif
