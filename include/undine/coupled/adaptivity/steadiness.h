// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_coupled_adaptivity_steadiness_h
#define undine_coupled_adaptivity_steadiness_h

#include <undine/base/core/column.h>
#include <undine/coupled/adaptivity/sample_norms.h>

#include <optional>
#include <vector>

namespace undine
{
  /// Finds out when fluid and bodies have become steady: when for some time neither the fluid's
  /// velocity, the bodies' displacement nor what the fluid does to bodies and obstacles has
  /// differed by more than a given part from what it was at the begin of that time,
  ///
  ///     |v(t) - v(s)| / |v(t)|,  |d(t) - d(s)| / |d(t)|  and  |f(t) - f(s)| / |f(t)|         (T11)
  ///
  /// v and d in root mean squares (SampleNorms), f being all forces of pressure and of friction on
  /// them, by axis, as `statistics` has them. As soon as it does, the time begins anew.
  template <int dim>
  class Steadiness
  {
  public:
    /// `within`: the part [1]; `lasting`: the time [s]. `models` must outlive it. Collective.
    Steadiness(const Models<dim> &models, double within, double lasting);

    /// Look at the state after a step, at `time` [s], and at its columns; the first one seen is
    /// compared with nothing.
    /// Returns the larger part of (T11) if it is steady [1], which it is not as long as nothing has
    /// moved. Collective.
    std::optional<double>
    observe(const State<dim> &state, const Columns &columns, double time);

  private:
    double
    change(const State<dim> &state, const std::vector<double> &forces) const;

    const Models<dim>     &models;
    const SampleNorms<dim> norms;
    const double           within;  ///< [1]
    const double           lasting; ///< [s]

    struct Reference
    {
      double                           time;   ///< s [s]
      Velocity<dim>                    fluid;  ///< v(s) [m/s]
      typename SolidModel<dim>::Vector bodies; ///< d(s) [m]
      std::vector<double>              forces; ///< f(s) [N]
    };
    std::optional<Reference> reference; ///< none: nothing has been seen
  };
} // namespace undine

#endif
