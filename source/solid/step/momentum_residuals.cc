// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/solid/assembly/loads.h>
#include <undine/solid/assembly/sums_by_body.h>
#include <undine/solid/step/solid_equations.h>

#include <algorithm>

namespace undine
{
  template <int dim>
  std::vector<double>
  SolidEquations<dim>::momentum_residuals(const Vector &velocity, const Vector &reactions) const
  {
    Vector defect = inertia(velocity);
    if (environment.mass_damping > 0)
      {
        Vector drag = model.vector(), product = model.vector();
        drag.add(coefficients.damping, velocity);
        drag.add(coefficients.damping_old_velocity, old_state.velocity);
        mass.vmult(product, drag);
        defect.add(environment.mass_damping, product);
      }
    defect.add(-1., dead);
    defect.add(-1., weighted(reactions));
    if (has_pressure)
      for (const auto &stage : coefficients.stages)
        defect.add(-stage.weight,
                   pressure_loads(model,
                                  stage_displacement(displacement(velocity), stage.position),
                                  time + stage.position * dt));
    const Vector pushes = contact_forces(displacement(velocity));
    if (pushes.size() > 0)
      defect.add(-1., pushes);
    // Where nothing acts, rounding is no lack of balance.
    const double        tolerance = model.numerics().newton.relative_tolerance;
    const double        size      = std::max(scale(), rounding() / tolerance);
    std::vector<double> result;
    for (const auto &force : sums_by_body(model, defect))
      result.push_back(size > 0 ? force.norm() / size : 0);
    return result;
  }


  template std::vector<double>
  SolidEquations<2>::momentum_residuals(const Vector &, const Vector &) const;
  template std::vector<double>
  SolidEquations<3>::momentum_residuals(const Vector &, const Vector &) const;
} // namespace undine
