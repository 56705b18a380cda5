// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_coupled_adaptivity_sleeping_bodies_h
#define undine_coupled_adaptivity_sleeping_bodies_h

#include <undine/coupled/budget/budget.h>
#include <undine/coupled/step/physics.h>
#include <undine/solid/mesh/part_of_bodies.h>
#include <undine/solid/step/solid_stepper.h>

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace undine
{
  /// The equations of a scene for those of its bodies that are awake. A body that sleeps is an
  /// obstacle that stands still: fluid flows around it, others touch it, and nothing is assembled
  /// or solved for it. Between steps the state holds all bodies.
  ///
  /// With V and T of SleepSettings, at the end of a step:
  ///
  ///  - a body falls asleep if no node has been faster than V for the time T; it keeps d, and what
  ///    is left of its u is taken away when the next step begins (the budget's term `sleep`);
  ///  - it wakes if sum_i |F_i - F_i'| > m V / T over the nodes of its surface (S18), F being the
  ///    loads of fluid and contact and F' those with which it fell asleep; the step is then done
  ///    again with it awake, so that none is accepted in which something that sleeps should not.
  ///
  /// Bodies with supports or loads that change in time never sleep.
  template <int dim>
  class SleepingBodies : public Physics<dim>
  {
  public:
    /// Makes the equations for a choice of models.
    using Make = std::function<std::unique_ptr<Physics<dim>>(const Models<dim> &)>;

    /// The stages of a step of this length [s] that begins without rates.
    using StartAnew = std::function<Stages(double)>;

    /// `models` are those of all bodies, of which there are some. The references must outlive it.
    /// Collective.
    SleepingBodies(const Models<dim> &models,
                   Budget<dim>       &budget,
                   TimingTree        &timing,
                   Make               make,
                   StartAnew          start_anew);

    void
    initialize(State<dim> &state, double dt, Report &report) override;

    /// Repeats the step until no body wakes in it, with those that woke awake from its begin. Where
    /// sleeping bodies leave the step without a solution, as in a region that only they close, all
    /// wake. With contact the step then begins without rates: those of bodies that touch leave out
    /// what contact gives, and bodies that slept have none.
    void
    advance(State<dim> &state, const Stages &stages, Report &report) override;

    void
    solve_stage(State<dim> &state, const Stage &stage, Report &report) override;

  private:
    using Vectors = std::vector<dealii::Tensor<1, dim>>;

    /// The models in place of those of all bodies, where some sleep.
    struct ReducedModels
    {
      std::unique_ptr<const SolidModel<dim>>   asleep;
      std::unique_ptr<const PartOfBodies<dim>> of_asleep;
      std::unique_ptr<const PartOfBodies<dim>> of_awake; ///< nullptr: none are
      Models<dim>                              models;   ///< of those awake
    };

    void
    choose(State<dim> &state);
    void
    compare_loads(State<dim> &state) const;
    std::vector<double>
    unbalanced(const State<dim> &state, const std::vector<bool> &asleep) const;
    void
    make_reduced_models(const State<dim> &state);
    void
    keep_still(const State<dim> &state);
    std::shared_ptr<const SolidMeasures<dim>>
    measure_asleep(const State<dim> &state) const;
    void
    take_rest(State<dim> &state);
    Vectors
    loads_on_bodies(const State<dim> &state, double time) const;
    void
    change_sleep(State<dim> &state, double dt, double time) const;
    bool
    has_fallen_asleep_in_contact(const State<dim>        &state,
                                 const std::vector<bool> &was_asleep,
                                 double                   time) const;
    bool
    count_quiet_time(State<dim> &state, double dt) const;
    void
    complete(Report &report, const State<dim> &state, double time) const;
    void
    add_columns(Report &report, const State<dim> &state) const;

    const Models<dim>                               &all;
    Budget<dim>                                     &budget;
    TimingTree                                      &timing;
    const Make                                       make;
    const StartAnew                                  start_anew;
    const SolidEnvironment<dim>                      environment; ///< of all bodies, but no contact
    const SleepSettings                              settings;
    const std::shared_ptr<const Contact<dim>>        contact;      ///< of all bodies; nullptr: none
    const std::unique_ptr<const BodySurface<dim>>    surface;      ///< nullptr: nothing acts on it
    const std::vector<unsigned int>                  body_of_node; ///< of that surface
    const std::vector<bool>                          may_sleep;    ///< [body]
    std::vector<double>                              masses;       ///< [body] [kg]
    std::vector<bool>                                sleepers; ///< [body] for which `physics` is
    std::unique_ptr<ReducedModels>                   part;     ///< nullptr: nobody sleeps
    std::unique_ptr<Physics<dim>>                    physics;  ///< nullptr: nothing is left to do
    std::vector<std::pair<std::string, std::string>> names;    ///< of its columns, with units

    /// Within a step. @{
    SolidState whole; ///< all bodies at t^n
    /// @}
  };
} // namespace undine

#endif
