// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_fluid_fluid_stage_h
#define undine_fluid_fluid_stage_h

#include <undine/base/core/stage.h>
#include <undine/base/core/timing.h>
#include <undine/fluid/advection/advection.h>
#include <undine/fluid/advection/characteristic_tracer.h>
#include <undine/fluid/convection/dual_fluxes.h>
#include <undine/fluid/grid/fluid_state.h>
#include <undine/fluid/model/fluid_model.h>
#include <undine/fluid/viscosity/body_impedance.h>

#include <deal.II/base/tensor.h>

#include <optional>
#include <vector>

namespace undine
{
  /// Forces on all nodes of surfaces by pressures of contact between bodies in a stage [N].
  template <int dim>
  struct ContactForces
  {
    using Vectors = std::vector<dealii::Tensor<1, dim>>;

    Vectors by_change; ///< of the pressure that acts in the stage, not in that of its end (S21)
    Vectors not_kept;  ///< of that which is not among the rates that are kept
  };


  /// What the effects work on while the fluid goes through a stage (Stage) of a step: they turn
  /// state.velocity from v^0 into v*, which the projection then makes divergence-free:
  ///
  ///  1. transport:  v' = A(v^0), A: advected by the flow                            (Advection)
  ///  2. accelerate: v'' = v' + g f
  ///  3. diffuse:    (1 - g nu Laplace) w = v'' - g grad q / rho,  v* = w + g grad q / rho
  ///  4. project:    v = v* - g grad p / rho,  div v = 0                          (Projection)
  ///  5. finish:     a = (v - v') / g or (v - A(v^b)) / duration,  q = p - mu div w
  ///
  /// with pressures q of the last stage. Friction acts on the flow that 4 will leave, not on one
  /// that still slips along walls: step 3 borrows the old pressure gradient and gives it back, the
  /// incremental pressure correction in its rotational form (Guermond, Minev & Shen 2006).
  ///
  /// Stages that keep rates (T10) start from v^0 = v^b + w a, v^b being the velocity at the stage's
  /// begin and a the acceleration of the fluid's parcels that the stage before has kept; the flow
  /// that advects is that in the middle of the stage,
  ///
  ///     v + (duration of the stage) / 2 dv/dt.
  ///
  /// A step of a single stage that keeps none is first order in time: forces act at t^{n+1} as a
  /// whole, which damps. Steady flows, however, hardly depend on h: v' = A(v^n + c h a^n) - c h a^n
  /// advects the share c of the parcels' acceleration too. In a steady flow c = 1/2 would be the
  /// trapezoidal rule along their paths: v + h a / 2 at the foot is v - h a / 2 at the head. A
  /// force -lambda v then multiplies v by (A - (A - 1) c z) / (1 + z) in a step, z = h lambda: up
  /// to 2 c for stiff friction and A = -1. c = 0.45 keeps that below one and takes away nine tenths
  /// of the error of first order in h.
  template <int dim>
  struct FluidStage
  {
    static constexpr double advected_share = 0.45; ///< c

    /// A stage of the step that begins at `time` = t^n. `tracer` gets its own copy of the flow,
    /// which later changes of `state` do not reach. The topology of the fluid, `bodies.topology`,
    /// may differ from that of `state`: velocity and scalars change to it when they are advected,
    /// the pressure does here. Collective.
    FluidStage(const FluidModel<dim>                            &model,
               FluidState<dim>                                  &state,
               const dealii::Tensor<1, dim>                     &gravity,
               double                                            time,
               const Stage                                      &stage,
               TimingTree                                       &timing,
               const typename CharacteristicTracer<dim>::Bodies &bodies = {});

    /// The velocities that convection advects.
    std::vector<Velocity<dim> *>
    advected_velocities();

    /// Convection in flux form asks for it before remap(): then that conserves momentum.
    void
    conserve_momentum()
    {
      conserves_momentum = true;
    }

    /// Bring fields that no effect has advected to the present topology of the fluid; their values
    /// stay where they were. Collective.
    void
    remap();

    /// What surfaces that move do to the fluxes of momentum, after remap(); empty: nothing, or
    /// nobody has asked.
    const std::optional<typename DualFluxes<dim>::Motion> &
    motion() const
    {
      return dual_motion;
    }

    /// The flow at the end of the stage on the present topology of the fluid, extrapolated from its
    /// begin if stages keep rates [m/s]. After remap(). Collective.
    Velocity<dim>
    flow_at_end() const;

    /// Ends the stage, after the projection: acceleration and pressure for the next one.
    void
    finish();

    const FluidModel<dim>       &model;
    FluidState<dim>             &state;
    const dealii::Tensor<1, dim> gravity; ///< uniform acceleration, in the reduced pressure [m/s^2]
    const Stage                  stage;
    const double                 time;  ///< where the paths of parcels begin [s]
    const double                 start; ///< where the implicit step begins [s]
    const double                 end;   ///< of both [s]
    const double                 dt;    ///< g, the length of the implicit step [s]
    TimingTree                  &timing;
    const CharacteristicTracer<dim> tracer;                ///< advects everything
    unsigned int                    linear_iterations = 0; ///< summed over implicit solves

    /// Is the mean rate of the stage kept, and another one than that at its end?
    bool
    keeps_mean() const
    {
      return stage.kept == KeptRate::mean && stage.going_on() != 0;
    }

    /// Of fields that advection takes along: one that has gone on with the rate that was kept,
    /// which may be nullptr, and, of two, what it was at the begin of the stage.
    GoingOn<dim>
    going_on(const std::size_t n_fields, const Field<dim> *rate) const
    {
      return {n_fields == 1 ? std::vector<double>{start} : std::vector<double>{start, time}, rate};
    }

    /// What the velocity at the begin of the stage has been advected to [m/s]; nullptr unless a
    /// mean rate is kept that differs from the rate at the end.
    const Velocity<dim> *
    advected_from_begin() const
    {
      return advected_begin ? &*advected_begin : nullptr;
    }

    /// The implicit terms, known before `diffuse`. @{
    double                               viscosity = 0; ///< of the effect `viscosity` [Pa s]
    std::optional<const DualFluxes<dim>> carrying;      ///< of the flux form of convection
    /// @}

    /// Of bodies that give way to friction, before `diffuse`; nullptr: surfaces move as is given.
    std::unique_ptr<BodyImpedance<dim>> impedance;

    /// The pressure of the stage before, on its topology, if surfaces have moved since [Pa].
    std::optional<Field<dim>> pressure_before;

    /// Results of effects for finish(). @{
    std::optional<Velocity<dim>> advected;            ///< v' [m/s], by convection
    std::optional<Field<dim>>    pressure_correction; ///< -mu div w [Pa], by viscosity
    std::optional<FrictionForces<dealii::Tensor<1, dim>>> friction; ///< by viscosity, with surfaces
    std::vector<dealii::Tensor<1, dim>> wall_velocities;            ///< for which that is [m/s]
    std::vector<dealii::Tensor<1, dim>>
      wall_damping; ///< about its derivative, with an impedance [kg/s]
    /// @}

    /// The contribution of forces of contact between bodies to the velocity at the end of the stage
    /// [m/s], which is no rate that the next stage goes on with; empty: none.
    std::optional<Velocity<dim>> by_contact;

    /// Those of the pressures of contact, if they are asked for; empty: none.
    ContactForces<dim> forces_by_contact;

    /// For the budget: the work of the effect that has just acted, on this rank, by the effect's
    /// own formula [J]; empty: it has none.
    std::optional<double> work;

  private:
    void
    go_on();
    void
    move_pressure_and_acceleration();
    void
    move_dual_volumes(const Velocity<dim> &velocity);
    Velocity<dim>
    remapped_velocity(const Velocity<dim> &velocity) const;

    bool                                            conserves_momentum = false;
    std::optional<typename DualFluxes<dim>::Motion> dual_motion;

    /// The same from samples alone, if it conserves momentum.
    std::optional<Velocity<dim>> resampled_begin;

    Velocity<dim> before; ///< velocity where the paths begin, if rates are kept [m/s]

    /// The same, advected, if a mean rate is kept and differs from that at the end [m/s].
    std::optional<Velocity<dim>> advected_begin;
  };
} // namespace undine

#endif
