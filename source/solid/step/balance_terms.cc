// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/core/errors.h>
#include <undine/solid/assembly/internal_forces.h>
#include <undine/solid/assembly/sums_by_body.h>
#include <undine/solid/step/balance_terms.h>

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace undine
{
  namespace
  {
    /// K(d) times `displacement_increment` [J].
    template <int dim>
    double
    internal_work(const SolidModel<dim>                  &model,
                  const typename SolidModel<dim>::Vector &displacement,
                  const typename SolidModel<dim>::Vector &displacement_increment)
    {
      return internal_forces(model, displacement) * displacement_increment;
    }


    /// The integral of internal_work() along the straight path to `end` [J]. Rules become finer
    /// until one gives the elastic energy gained, or what the one before has given, up to
    /// `resolved` [J]: an energy that is small beside the stiffness times the volume is rounded by
    /// more. Two points integrate the forces of Saint Venant and Kirchhoff's law exactly.
    template <int dim>
    double
    work_along_path(const StepMotion<dim>                  &motion,
                    const typename SolidModel<dim>::Vector &end,
                    const typename SolidModel<dim>::Vector &displacement_increment,
                    const double                            elastic_energy_gained,
                    const double                            resolved)
    {
      const std::vector<dealii::Quadrature<1>> rules = {
        dealii::QGauss<1>(2),
        dealii::QGauss<1>(4),
        dealii::QGauss<1>(8),
        dealii::QIterated<1>(dealii::QGauss<1>(6), 4),
        dealii::QIterated<1>(dealii::QGauss<1>(6), 16)};
      double result = elastic_energy_gained;
      for (const auto &rule : rules)
        {
          const double last = result;
          result            = 0;
          for (unsigned int q = 0; q < rule.size(); ++q)
            result +=
              rule.weight(q) * internal_work(motion.model(),
                                             motion.level_displacement(end, rule.point(q)[0]),
                                             displacement_increment);
          if (std::min(std::abs(result - last), std::abs(result - elastic_energy_gained)) <=
              resolved)
            break;
        }
      return result;
    }
  } // namespace


  template <int dim>
  dealii::Tensor<1, dim>
  resultant(const SolidModel<dim> &model, const typename SolidModel<dim>::Vector &forces)
  {
    dealii::Tensor<1, dim> result;
    for (const auto &of_body : sums_by_body(model, forces))
      result += of_body;
    return result;
  }


  template <int dim>
  void
  balance_inertia(SolidBalance<dim>                      &result,
                  const StepMotion<dim>                  &motion,
                  const typename SolidModel<dim>::Matrix &mass,
                  const typename SolidModel<dim>::Vector &force,
                  const typename SolidModel<dim>::Vector &velocity,
                  const typename SolidModel<dim>::Vector &displacement_increment)
  {
    using Vector           = typename SolidModel<dim>::Vector;
    const auto  &model     = motion.model();
    const auto  &old_state = motion.old_state();
    const double dt        = motion.dt();
    Vector       change = velocity, mean = velocity, gain = model.vector();
    change.add(-1., old_state.velocity);
    mean.sadd(0.5, 0.5, old_state.velocity);
    mass.vmult(gain, change);
    result.kinetic = gain * mean;
    // force.displacement_increment - gain.mean without the difference of nearly equal numbers.
    Vector further = displacement_increment, more = force;
    further.add(-dt, mean);
    more.add(-1 / dt, gain);
    result.inertia_loss = force * further + dt * (more * mean);
    // Supports move as prescribed, further than their velocity at the end of a stage says.
    further = displacement_increment;
    further.add(-dt, velocity);
    result.inertia_on_path = force * further;
    result.momentum        = resultant(model, gain);
    result.inertia_gap     = dt * resultant(model, more);
  }


  template <int dim>
  void
  balance_elasticity(SolidBalance<dim>                      &result,
                     const StepMotion<dim>                  &motion,
                     const typename SolidModel<dim>::Vector &end,
                     const typename SolidModel<dim>::Vector &displacement_increment,
                     const double                            rounding)
  {
    const auto &model     = motion.model();
    const auto &old_state = motion.old_state();
    result.elastic = elastic_energy(model, end) - elastic_energy(model, old_state.displacement);
    for (const auto &level : motion.coefficients().levels)
      result.elastic_work +=
        level.weight * internal_work(model,
                                     motion.level_displacement(end, level.position),
                                     displacement_increment);
    result.elastic_loss = result.elastic_work;
    try
      {
        const double resolved =
          std::max(1e-12 * elastic_energy(model, end), rounding * displacement_increment.l2_norm());
        result.elastic_loss -=
          work_along_path(motion, end, displacement_increment, result.elastic, resolved);
      }
    catch (const SolveError &)
      {
        // The straight path leads through an inverted state: there is no such integral.
        result.elastic_loss -= result.elastic;
      }
  }


#define UNDINE_INSTANTIATE(dim)                                                       \
  template dealii::Tensor<1, dim> resultant(const SolidModel<dim> &,                  \
                                            const SolidModel<dim>::Vector &);         \
  template void                   balance_inertia(SolidBalance<dim> &,                \
                                                  const StepMotion<dim> &,            \
                                                  const SolidModel<dim>::Matrix &,    \
                                                  const SolidModel<dim>::Vector &,    \
                                                  const SolidModel<dim>::Vector &,    \
                                                  const SolidModel<dim>::Vector &);   \
  template void                   balance_elasticity(SolidBalance<dim> &,             \
                                                     const StepMotion<dim> &,         \
                                                     const SolidModel<dim>::Vector &, \
                                                     const SolidModel<dim>::Vector &, \
                                                     double);

  UNDINE_INSTANTIATE(2)
  UNDINE_INSTANTIATE(3)
#undef UNDINE_INSTANTIATE
} // namespace undine
