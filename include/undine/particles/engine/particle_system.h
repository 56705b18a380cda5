// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_particles_engine_particle_system_h
#define undine_particles_engine_particle_system_h

#include <undine/particles/boundaries/drive_openings.h>
#include <undine/particles/boundaries/moving_walls.h>
#include <undine/particles/boundaries/open_boundaries.h>
#include <undine/particles/elasticity/elastic_arrays.h>
#include <undine/particles/elasticity/elastic_step.h>
#include <undine/particles/engine/measure_throughput.h>
#include <undine/particles/engine/particle_arrays.h>
#include <undine/particles/engine/pass_results.h>
#include <undine/particles/execution/phases.h>
#include <undine/particles/fluid/even_spacing.h>
#include <undine/particles/fluid/explicit_forces.h>
#include <undine/particles/fluid/local_shift.h>
#include <undine/particles/fluid/volume_error.h>
#include <undine/particles/multigrid/multigrid_arrays.h>
#include <undine/particles/neighbours/cell_sort.h>
#include <undine/particles/neighbours/neighbour_list.h>
#include <undine/particles/pressure/conjugate_gradients.h>
#include <undine/particles/pressure/damped_iterations.h>
#include <undine/particles/pressure/pressure_arrays.h>
#include <undine/particles/pressure/pressure_forces.h>
#include <undine/particles/pressure/take_out_mean.h>
#include <undine/particles/setup/make_constants.h>

#include <memory>

namespace undine::particles
{
  /// The particles of a scene where an executor works, and the order of the passes that move them.
  template <class Executor, int dim, class Real, class Entry>
  class ParticleSystem
  {
  public:
    ParticleSystem(Executor                          &executor,
                   const Setup<dim>                  &setup,
                   const ReferenceLattice<dim, Real> &lattice,
                   const int                          n)
      : executor(executor)
      , numerics(setup.numerics)
      , constants(make_constants<dim, Real>(setup))
      , has_fluid(setup.has_fluid)
      , bounds(make_bounds(setup, lattice.rate()))
      , n(n)
      , now(executor, n)
      , next(executor, n)
      , bodies(executor, lattice, NeighbourList<Executor, dim, Real>::capacity)
      , control(executor, 1)
      , cells(executor, constants.grid, n)
      , list(executor, constants.grid, constants.reach, n)
      , equation(executor, n, bodies.n)
      , open(make_open_boundaries<dim, Real>(setup))
      , crossed(executor, open.n > 0 ? n : 0)
      , crossed_before(executor, open.n > 0 ? n : 0)
      , moving_walls(executor, constants, bodies.n, setup.n_moving)
    {
      constants.bodies  = bodies.materials.data();
      const auto wanted = numerics.preconditioner;
      if (wanted == Numerics::Preconditioner::multigrid ||
          (wanted == Numerics::Preconditioner::automatic && n > Executor::multigrid_pays_from))
        multigrid =
          std::make_unique<MultigridArrays<Executor, dim, Real>>(executor, constants.grid, n);
    }

    /// The particles as they are; fill, then call prepare().
    ParticleArrays<Executor, dim, Real> &
    arrays()
    {
      return now;
    }

    ElasticArrays<Executor, dim, Real> &
    elastic()
    {
      return bodies;
    }

    /// Sort and find neighbours for the first time.
    void
    prepare()
    {
      sort();
      list.find(now.view(), cells.cell_starts(), control.data());
      if (equation.ways() != nullptr)
        executor.for_each(
          n, MeasureInwardDirections<dim, Real>{constants, neighbours(), equation.ways()});
    }

    Neighbours<dim, Real>
    neighbours() const
    {
      return list.view(now.view());
    }

    /// Particles that wait to flow in; knows what the last sort left.
    int
    count_parked() const
    {
      int first;
      executor.download(&first, cells.first_parked(), 1);
      return n - first;
    }

    StepControl
    read_control() const
    {
      return control.values()[0];
    }

    StepControl *
    begin_frame(const StepControl &value, const WallPaths<dim> &paths)
    {
      moving_walls.set_paths(paths);
      control.set({value});
      return control.data();
    }

    /// One sub-step of the length that it chooses itself; nothing after the end of the frame.
    void
    sub_step()
    {
      executor.enter(Phase::forces);
      executor.for_each(1, ChooseStep{control.data(), bounds});
      move_without_pressure();
      if (open.n > 0)
        cross_boundaries();
      sort();
      executor.enter(Phase::neighbours);
      list.find(now.view(), cells.cell_starts(), control.data());
      if (!has_fluid)
        return;
      if (has_openings())
        executor.for_each(n,
                          DriveOpenings<dim, Real>{constants,
                                                   open,
                                                   now.places.data(),
                                                   cells.cell_starts(),
                                                   now.motions.data(),
                                                   control.data()});
      solve_pressure();
      move_by_pressure();
    }

    /// What the passes of the last sub-step left behind, in their order.
    std::vector<PassResult>
    pass_results() const
    {
      return particles::pass_results(now, next, equation, bodies);
    }

    /// Of the last sub-step's matrix.
    Throughput
    throughput()
    {
      return ThroughputMeasurement<Executor, Real, Entry>(executor)(
        {pressure_system().system, equation.numbers.data(), 0});
    }

  private:
    template <class Value>
    using Values = Buffer<Executor, typename Components<Value>::Stored>;

    void
    move_without_pressure()
    {
      executor.for_each(n,
                        ExplicitForces<dim, Real>{constants,
                                                  neighbours(),
                                                  now.motions.data(),
                                                  now.identities.data(),
                                                  next.places.data(),
                                                  next.motions.data(),
                                                  bodies.v_start.data(),
                                                  {constants.fluid_density, equation.ways()},
                                                  control.data()});
      std::swap(now.places, next.places);
      std::swap(now.motions, next.motions);
      moving_walls.move(now.view(), control.data());
      move_bodies(has_fluid ? ElasticRun::attempt : ElasticRun::alone);
    }

    void
    cross_boundaries()
    {
      executor.for_each(n,
                        CrossBoundaries<dim, Real>{open,
                                                   constants.spacing,
                                                   constants.pressure_place,
                                                   now.places.data(),
                                                   now.motions.data(),
                                                   crossed.data(),
                                                   control.data()});
      executor.exclusive_scan(n, crossed.data(), crossed_before.data());
      executor.for_each(n,
                        RefillLayers<dim, Real>{open,
                                                n,
                                                now.places.data(),
                                                now.motions.data(),
                                                crossed.data(),
                                                crossed_before.data(),
                                                cells.first_parked(),
                                                control.data()});
    }

    void
    sort()
    {
      executor.enter(Phase::sort);
      cells.sort(now.view(), next.view(), bodies.where.data(), bodies.n);
      std::swap(now, next);
      moving_walls.take_room(now.view(), cells.cell_starts());
    }

    void
    solve_pressure()
    {
      executor.enter(Phase::assembly);
      if (constants.coupling == Coupling::surface_pressure)
        executor.for_each(
          bodies.n,
          GiveSurfacePressures<dim, Real>{bodies.view(), now.motions.data(), bodies.where.data()});
      executor.for_each(n,
                        MeasureNeighbourhood<dim, Real>{constants,
                                                        neighbours(),
                                                        now.identities.data(),
                                                        bodies.inside.data(),
                                                        equation.neighbourhood(),
                                                        control.data()});
      if (has_openings())
        executor.run(n,
                     MeasureVolumeError<dim, Real>{
                       n, now.places.data(), equation.neighbourhood().fillings, control.data()});
      const bool closed = constants.pair_force == PairForce::balanced;
      executor.for_each(
        n,
        AssemblePressure<dim, Real, Entry>{constants,
                                           neighbours(),
                                           equation.neighbourhood(),
                                           faces(),
                                           matrix(),
                                           equation.diagonal.data(),
                                           closed ? equation.faces_diagonal.data() : nullptr,
                                           equation.gaps.data(),
                                           now.motions.data(),
                                           equation.right_hand_side.data(),
                                           control.data()});
      executor.enter(Phase::faces);
      if (closed)
        take_out_mean<Vector<dim, Real>>(equation.gaps, MeanOf::right_hand_side);
      if (closed)
        executor.run(n,
                     DampedIterations<Real, Entry, Vector<dim, Real>>{
                       system<Vector<dim, Real>>(equation.faces_diagonal,
                                                 equation.gaps,
                                                 now.potentials,
                                                 equation.vectors.data(),
                                                 numerics.faces_tolerance,
                                                 &StepControl::faces)});
      executor.enter(Phase::assembly);
      executor.for_each(n,
                        MeasureSource<dim, Real, Entry>{constants,
                                                        neighbours(),
                                                        equation.neighbourhood(),
                                                        faces(),
                                                        matrix(),
                                                        now.motions.data(),
                                                        equation.right_hand_side.data(),
                                                        equation.pressures.data(),
                                                        control.data()});
      take_out_mean<Real>(equation.right_hand_side, MeanOf::right_hand_side);
      solve_pressure_equation();
      take_out_mean<Real>(equation.pressures, MeanOf::solution);
      executor.for_each(n,
                        TakePressures<dim, Real>{equation.neighbourhood(),
                                                 equation.pressures.data(),
                                                 now.view(),
                                                 constants.coupling == Coupling::surface_pressure,
                                                 constants.is_full,
                                                 control.data()});
    }

    /// Where pressures are known up to a constant.
    template <class Value>
    void
    take_out_mean(const Values<Value> &values, const MeanOf of)
    {
      if (constants.is_closed)
        executor.run(
          n,
          TakeOutMean<dim, Real, Value>{
            of, n, now.places.data(), equation.is_unknown.data(), values.data(), control.data()});
    }

    /// In a full domain.
    bool
    has_openings() const
    {
      return constants.is_full && !constants.is_closed;
    }

    void
    move_by_pressure()
    {
      executor.enter(Phase::correction);
      executor.for_each(n,
                        PressureForces<dim, Real>{constants,
                                                  neighbours(),
                                                  equation.neighbourhood(),
                                                  faces(),
                                                  now.motions.data(),
                                                  now.identities.data(),
                                                  next.places.data(),
                                                  next.motions.data(),
                                                  equation.gaps.data(),
                                                  equation.vectors.data(),
                                                  bodies.accelerations.data(),
                                                  control.data()});
      if (constants.is_full)
        executor.for_each(n,
                          EvenSpacing<dim, Real>{constants,
                                                 neighbours(),
                                                 equation.neighbourhood(),
                                                 now.motions.data(),
                                                 next.places.data(),
                                                 next.motions.data(),
                                                 control.data()});
      else if (constants.is_alone)
        executor.for_each(
          n,
          LocalShift<dim, Real>{
            constants, neighbours(), equation.vectors.data(), next.places.data(), control.data()});
      std::swap(now.places, next.places);
      std::swap(now.motions, next.motions);
      move_bodies(ElasticRun::final);
    }

    void
    move_bodies(const ElasticRun purpose)
    {
      if (bodies.n == 0)
        return;
      executor.enter(Phase::bodies);
      const auto view = bodies.view();
      executor.run_by_lanes(
        bodies.n,
        ElasticStep<dim, Real>{purpose,
                               {constants.grid, constants.spacing, constants.reach, view},
                               {constants.spacing,
                                view,
                                neighbours(),
                                now.identities.data(),
                                bodies.where.data(),
                                now.motions.data(),
                                constants.volume,
                                bodies.partner_counts.data(),
                                bodies.partners.data()},
                               constants.force,
                               constants.displaced_density,
                               constants.is_closed,
                               constants.top_potential,
                               bodies.x_start.data(),
                               bodies.v_start.data(),
                               bodies.points_next.data(),
                               bodies.implicit_vectors(),
                               bodies.accelerations.data(),
                               bodies.carried.data(),
                               constants.coupling == Coupling::simultaneous
                                 ? static_cast<Real>(numerics.carry_share)
                                 : Real(0),
                               now.places.data(),
                               now.motions.data(),
                               bounds,
                               control.data()});
    }

    void
    solve_pressure_equation()
    {
      if (multigrid == nullptr)
        {
          executor.enter(Phase::pressure);
          executor.run(n, pressure_system());
          return;
        }
      executor.enter(Phase::multigrid);
      multigrid->build(now.places.data(),
                       equation.is_unknown.data(),
                       matrix(),
                       equation.diagonal.data(),
                       cells.cell_starts());
      executor.enter(Phase::pressure);
      multigrid->solve(pressure_system(), cells.cell_starts());
    }

    /// `w` has room for five numbers a particle.
    template <class Value>
    ConjugateGradients<Real, Entry, Value>
    system(const Buffer<Executor, Real>       &system_diagonal,
           const Values<Value>                &b,
           Values<Value>                      &x,
           typename Components<Value>::Stored *w,
           const double                        tolerance,
           SolverRecord StepControl::*record) const
    {
      return {
        {matrix(), system_diagonal.data(), b.data(), x.data(), now.identities.data(), bodies.n},
        {w, w + n, w + 2 * n, w + 3 * n, w + 4 * n},
        {tolerance, numerics.max_iterations},
        control.data(),
        record};
    }

    ConjugateGradients<Real, Entry, Real>
    pressure_system()
    {
      return system<Real>(equation.diagonal,
                          equation.right_hand_side,
                          equation.pressures,
                          equation.numbers.data(),
                          numerics.tolerance,
                          &StepControl::pressure);
    }

    VirtualFaces<dim, Real>
    faces() const
    {
      return {dim / constants.number_density,
              equation.corrections.data(),
              constants.pair_force == PairForce::balanced ? now.potentials.data() : nullptr};
    }

    PressureMatrix<Real, Entry>
    matrix() const
    {
      return equation.matrix(largest_coefficient(constants));
    }

    Executor            &executor;
    Numerics             numerics;
    Constants<dim, Real> constants;
    bool                 has_fluid;
    StepBounds           bounds;
    int                  n;

    ParticleArrays<Executor, dim, Real>                   now, next;
    ElasticArrays<Executor, dim, Real>                    bodies;
    Buffer<Executor, StepControl>                         control;
    CellSort<Executor, dim, Real>                         cells;
    NeighbourList<Executor, dim, Real>                    list;
    PressureArrays<Executor, dim, Real, Entry>            equation;
    OpenBoundaries<dim, Real>                             open;
    Buffer<Executor, int>                                 crossed, crossed_before;
    MovingWalls<Executor, dim, Real>                      moving_walls;
    std::unique_ptr<MultigridArrays<Executor, dim, Real>> multigrid; ///< nullptr: not used
  };
} // namespace undine::particles

#endif
