// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_fluid_advection_characteristic_tracer_h
#define undine_fluid_advection_characteristic_tracer_h

#include <undine/fluid/boundary/boundary_condition.h>
#include <undine/fluid/boundary/no_slip_surfaces.h>
#include <undine/fluid/model/fluid_model.h>
#include <undine/fluid/visibility/visible_samples.h>

#include <array>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace undine
{
  /// Characteristic tracing: with the velocity at one time, which advects fields during a step, it
  /// finds where the fluid that arrives at a place has come from.
  template <int dim>
  class CharacteristicTracer
  {
  public:
    using Place = typename BodyVicinity<dim>::Place;

    /// The other end of the path of a particle.
    struct Trace
    {
      Place  foot;
      bool   left_domain; ///< it met an opening or an inflow there before the time had passed
      bool   near_body;   ///< it came near one, see BodyVicinity
      Side   side;        ///< by which it left
      double inside;      ///< for how long it was in the domain [s]
    };

    /// The bodies among which the fluid moves.
    struct Bodies
    {
      /// Their surfaces at the time of the step; nullptr: none.
      const Obstruction<dim> *obstruction = nullptr;
      /// The topology of the fluid now, which advected fields get; nullptr: nothing is cut.
      std::shared_ptr<const FluidTopology<dim>> topology;
      /// The no-slip surfaces, and the velocities of their nodes [m/s]; nullptr: none.
      std::shared_ptr<const NoSlipSurfaces<dim>> walls           = nullptr;
      std::vector<dealii::Tensor<1, dim>>        wall_velocities = {};
    };

    /// Copies `velocity`, which is that at `time_of_flow` [s], for steps of length dt [s] from
    /// `time` on. It may belong to an earlier position of the bodies. The model must outlive this.
    /// Collective. Throws SolveError if the velocity is not finite.
    CharacteristicTracer(const FluidModel<dim> &model,
                         const Velocity<dim>   &velocity,
                         const double           time,
                         const double           dt,
                         const Bodies          &bodies,
                         const double           time_of_flow);

    /// The same with the velocity at `time`.
    CharacteristicTracer(const FluidModel<dim> &model,
                         const Velocity<dim>   &velocity,
                         const double           time,
                         const double           dt,
                         const Bodies          &bodies = {})
      : CharacteristicTracer(model, velocity, time, dt, bodies, time)
    {
    }

    CharacteristicTracer(const CharacteristicTracer &) = delete;
    CharacteristicTracer &
    operator=(const CharacteristicTracer &) = delete;

    const FluidModel<dim> &
    model() const;

    /// [s]
    double
    time() const;

    /// [s]
    double
    dt() const;

    /// With ghost layers and boundary points.
    const Velocity<dim> &
    velocity() const;

    const Bodies &
    bodies() const;

    /// Which cells are near bodies.
    const BodyVicinity<dim> &
    vicinity() const;

    /// The visibility stencils of fields like this one, which has what completed() gives it; made
    /// once for all that are alike. Only where there are bodies. Collective.
    const std::shared_ptr<VisibilityStencils<dim>> &
    stencils(const Field<dim> &like) const;

    /// Ghost layers that a field needs to be known at every foot.
    const GridIndex<dim> &
    width() const;

    /// How far from a point of a lattice the points around the foot of its path can be: the two
    /// between which the foot lies and `beyond` more on either side.
    GridIndex<dim>
    reach(const int beyond) const;

    /// Follow the particle at `place` for a time (negative: back to where it came from), by the
    /// midpoint rule (F7), x' = x + dt v(x + dt v(x) / 2). The path ends at inflows and openings,
    /// and just before surfaces of bodies; at walls it goes on along the wall; periodic sides are
    /// passed.
    Trace
    trace(const dealii::Point<dim> &place, const double dt) const;

  private:
    /// Interpolated velocity [m/s]; next to bodies from visible samples or, where there are none,
    /// the velocity of the nearest surface.
    dealii::Tensor<1, dim>
    velocity_at(const Place &place) const;

    /// Through a side, after a share of the path.
    struct Leaving
    {
      Side   side;
      double share;
    };

    struct Walk
    {
      Place                  end;
      std::optional<Leaving> leaving;
    };

    /// The end of a straight path from a place, which ends before a surface and stays in the
    /// domain.
    Walk
    walk(const Place &place, const dealii::Tensor<1, dim> &path) const;

    /// The same without regard to bodies.
    std::pair<dealii::Point<dim>, std::optional<Leaving>>
    kept_in_domain(const dealii::Point<dim> &place, const dealii::Tensor<1, dim> &path) const;

    const FluidModel<dim>                                        &fluid_model;
    Bodies                                                        among;
    Velocity<dim>                                                 frozen_velocity;
    double                                                        start_time;
    double                                                        step;
    GridIndex<dim>                                                ghost_width;
    BodyVicinity<dim>                                             body_vicinity;
    mutable std::vector<std::shared_ptr<VisibilityStencils<dim>>> stencils_made;
    std::array<std::unique_ptr<VisibleSamples<dim>>, dim>         samples; ///< nullptr: no bodies
  };
} // namespace undine

#endif
