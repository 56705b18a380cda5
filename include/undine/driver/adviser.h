// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_driver_adviser_h
#define undine_driver_adviser_h

#include <undine/coupled/model/models.h>
#include <undine/coupled/state/report.h>
#include <undine/coupled/state/state.h>

#include <set>
#include <string>
#include <vector>

namespace undine
{
  /// Advice of a run about the effects that a scene calls for.
  struct Advice
  {
    /// A dimensionless number of the run.
    struct Number
    {
      std::string name;
      double      value; ///< [1]
      std::string meaning;
    };

    /// An effect that is on and does not matter, or is off and would.
    struct Remark
    {
      std::string effect;
      bool        is_on;
      std::string number; ///< by which that is known
      double      value;  ///< of it [1]
      std::string rule;
    };

    std::vector<Number> numbers;
    std::vector<Remark> remarks;

    /// Columns of `statistics` that the rules need and no step had: what follows from them is not
    /// judged.
    std::vector<std::string> missing;
  };


  /// The largest of what was measured during a run.
  struct Extremes
  {
    double speed        = 0; ///< of the fluid [m/s]
    double body_speed   = 0; ///< [m/s]
    double displacement = 0; ///< of the bodies from where they were at the start [m]
    double gradient     = 0; ///< |dd/dX| in the bodies [1]
    double length = 0; ///< of a body or obstacle in the fluid along an axis, or of the domain [m]
    double viscosity   = 0; ///< dynamic [Pa s]
    double lift        = 0; ///< relative change of the fluid's density by carried fields [1]
    double damped      = 0; ///< sum of |energy by damping|, where there is a budget [J]
    double body_energy = 0; ///< kinetic and elastic [J]
    double time        = 0; ///< how long it was [s]
  };


  /// Measures during a run and names effects that could be left out, or that are missing, by these
  /// measurements alone. Not for particles.
  template <int dim>
  class Adviser
  {
  public:
    /// `start` is the state at the beginning. The models must outlive it. Collective.
    Adviser(const Models<dim> &models, const State<dim> &start);

    /// A step of `dt` [s] has led to `state`. Collective.
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
