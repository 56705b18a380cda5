// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_solid_step_solid_columns_h
#define undine_solid_step_solid_columns_h

#include <undine/base/core/column.h>
#include <undine/solid/assembly/solid_environment.h>
#include <undine/solid/mesh/solid_model.h>
#include <undine/solid/mesh/solid_state.h>
#include <undine/solid/step/solid_stepper.h>

#include <vector>

namespace undine
{
  /// Integrals over the bodies, all collective. @{

  /// The kinetic energy u.M u / 2 [J].
  template <int dim>
  double
  kinetic_energy(const SolidModel<dim>                        &model,
                 const dealii::TrilinosWrappers::SparseMatrix &mass,
                 const dealii::TrilinosWrappers::MPI::Vector  &velocity);

  /// The potential -d.f of the dead loads f at `time` [s], [J]. Follower pressures have no
  /// potential and are left out.
  template <int dim>
  double
  load_potential(const SolidModel<dim>                       &model,
                 const SolidEnvironment<dim>                 &environment,
                 const dealii::TrilinosWrappers::MPI::Vector &displacement,
                 double                                       time);

  /// The linear momentum int rho u dX of all bodies [kg m/s].
  template <int dim>
  dealii::Tensor<1, dim>
  linear_momentum(const SolidModel<dim>                       &model,
                  const dealii::TrilinosWrappers::MPI::Vector &velocity);

  /// The angular momentum int rho (X + d) x u dX of all bodies about the origin [kg m^2/s]; in 2D
  /// only the third component is not zero.
  template <int dim>
  dealii::Tensor<1, 3>
  angular_momentum(const SolidModel<dim>                       &model,
                   const dealii::TrilinosWrappers::MPI::Vector &displacement,
                   const dealii::TrilinosWrappers::MPI::Vector &velocity);

  /// Mass, volume and centre of mass of a body.
  template <int dim>
  struct BodyMeasure
  {
    double             mass   = 0;     ///< [kg]
    double             volume = 0;     ///< deformed [m^dim]
    dealii::Point<dim> centre_of_mass; ///< deformed [m]
  };

  /// One for each body. Throws nothing, whatever the displacement.
  template <int dim>
  std::vector<BodyMeasure<dim>>
  measure_bodies(const SolidModel<dim>                       &model,
                 const dealii::TrilinosWrappers::MPI::Vector &displacement);

  /// The largest |u| of the nodes of each body [m/s].
  template <int dim>
  std::vector<double>
  maximum_speeds(const SolidModel<dim>                       &model,
                 const dealii::TrilinosWrappers::MPI::Vector &velocity);
  /// @}

  /// The measures of the bodies in `statistics` at one time, in 2D per metre of depth. All of them
  /// are zero for bodies that a model leaves out.
  template <int dim>
  struct SolidMeasures
  {
    /// The measures of one body.
    struct OfBody
    {
      BodyMeasure<dim>                    measure;
      double                              drift    = 0; ///< V / V(t = 0) - 1 [1]
      double                              speed    = 0; ///< the largest [m/s]
      double                              residual = 0; ///< of the balance of momentum [1]
      std::vector<dealii::Tensor<1, dim>> supports;     ///< force of each boundary [N]
    };

    double                 kinetic_energy = 0; ///< [J]
    double                 elastic_energy = 0; ///< [J]
    double                 load_potential = 0; ///< [J]
    dealii::Tensor<1, dim> momentum;           ///< [kg m/s]
    std::vector<OfBody>    bodies;
  };

  /// The measures of the bodies that the model has. `report` is that of the step that led to
  /// `state`: with an empty one, balances and reactions are zero. Collective.
  template <int dim>
  SolidMeasures<dim>
  measure_solid(const SolidModel<dim>       &model,
                const SolidStepper<dim>     &step,
                const SolidEnvironment<dim> &environment,
                const SolidState            &state,
                double                       time,
                const SolidReport<dim>      &report);

  /// The columns of `statistics` for these measures; `bodies` gives the names.
  template <int dim>
  Columns
  columns_of(const SolidMeasures<dim> &measures, const std::vector<Body<dim>> &bodies);

  /// Energies and momentum; volume, its drift (V / V(t = 0) - 1), centre of mass, largest speed and
  /// balance of momentum of every body; and the force of every support ("reaction beam/root x").
  /// Bodies that sleep (`environment`) count with what they measured when they fell asleep; then
  /// contact, if there is. Other arguments: see measure_solid(). Collective.
  template <int dim>
  Columns
  solid_columns(const SolidModel<dim>       &model,
                const SolidStepper<dim>     &step,
                const SolidEnvironment<dim> &environment,
                const SolidState            &state,
                double                       time,
                const SolidReport<dim>      &report);
} // namespace undine

#endif
