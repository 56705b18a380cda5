// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_driver_adviser_h
#define undine_driver_adviser_h

#include <undine/coupled/model/models.h>
#include <undine/coupled/state/report.h>
#include <undine/coupled/state/state.h>
#include <undine/driver/advice.h>

#include <set>
#include <string>

namespace undine
{
  /// Measures during a run and names effects that could be left out, or that are missing, by these
  /// measurements alone. Not for particles.
  template <int dim>
  class Adviser
  {
  public:
    /// `start` is the state at the beginning. The models must outlive it. Collective.
    Adviser(const Models<dim> &models, const State<dim> &start);

    /// The step of `report` has led to `state`. Collective.
    void
    observe(const State<dim> &state, const Report &report);

    /// Collective.
    Advice
    advice() const;

  private:
    void
    measure_length(const State<dim> &state);
    double
    column(const Columns &columns, const std::string &name);

    const Models<dim>                    &models;
    dealii::TrilinosWrappers::MPI::Vector first_displacement;
    Extremes                              largest;
    std::set<std::string>                 missing; ///< see Advice
  };
} // namespace undine

#endif
