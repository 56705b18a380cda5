// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_driver_advice_h
#define undine_driver_advice_h

#include <undine/coupled/model/models.h>

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
    double lift        = 0; ///< relative change of the fluid's density by advected fields [1]
    double damped      = 0; ///< sum of |energy by damping|, where there is a budget [J]
    double body_energy = 0; ///< kinetic and elastic [J]
    double time        = 0; ///< how long it was [s]
  };


  /// The numbers of a run with these largest values, and the effects that could be left out, or
  /// that are missing, by these numbers.
  template <int dim>
  Advice
  make_advice(const Models<dim> &models, const Extremes &largest);
} // namespace undine

#endif
