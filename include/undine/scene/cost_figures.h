// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_scene_cost_figures_h
#define undine_scene_cost_figures_h

#include <array>

namespace undine
{
  /// What runs have taken, by which others are estimated. Memory: largest resident sets of runs of
  /// the ladder of benchmarks/size_estimates.py. Seconds: doc/costs.md, if nothing else is said, on
  /// one core of the machine named there. Rows are for 2D and 3D. When they are measured anew,
  /// benchmarks/size_estimates.py tells how far estimates are off.
  namespace cost_figures
  {
    /// A rank's program and libraries: a cavity of 4096 cells, 183 MB; it counts once a rank,
    /// although ranks of a host share some of it. [bytes]
    constexpr double program = 180e6;
    /// More libraries, and what does not grow with the scene, where fluid and bodies are solved
    /// together: prm/jet_two_sheets.prm. [bytes]
    constexpr double program_of_coupling = 35e6;
    /// Of a step in which there is nothing to compute [s].
    constexpr double least_step = 1e-3;
    /// n ranks are n to this power times as fast as one: 1.75 for 2 (plume, 998400 cells).
    constexpr double gain_of_ranks = 0.8;

    /// The fluid's grid.
    struct Grid
    {
      double bytes;          ///< of a cell: plume, 64 x 128 x 64; taylor_green, 768^2
      double bytes_advected; ///< of a cell for each advected field: the same two
      double bytes_implicit; ///< of a cell for each implicit field: cavity, 400^2
      double bytes_cut;      ///< of a cut cell: ball_in_stream, three sizes
      double bytes_facet;    ///< of a facet, on each rank: the same
      double projection;     ///< a cell: plume's phases but transport; "Projection" there [s]
      double advected;       ///< a cell and field: plume's transport [s]
      double implicit;       ///< a cell and field: cavity, CPU time of a run [s]
      double advected_cut;   ///< a cut cell and field: ball_in_stream's transport less plume's [s]
      double moving; ///< a cell around what moves: the ball that moves less the fixed one [s]
      double
        cut_coupled;  ///< a cut cell, solving together with bodies: see Solid::coupled_entry [s]
      double contact; ///< a facet, where bodies may touch: the same scenes with contact [s]
    };
    constexpr std::array<Grid, 2> grid{
      {{650, 80, 170, 3e3, 300, 0.9e-6, 0.3e-6, 0.35e-6, 5e-6, 1e-6, 110e-6, 0.9e-3},
       {550, 75, 170, 30e3, 1500, 1.2e-6, 0.35e-6, 0.5e-6, 60e-6, 1.8e-6, 0, 19e-3}}};
    /// A cut cell for each implicit field, whatever the dimension: see Solid::coupled_entry. [s]
    constexpr double implicit_cut = 64e-6;

    /// Bodies of finite elements: prm/cantilever.prm, three sizes.
    struct Solid
    {
      double bytes_entry;  ///< of the tangent that is not zero
      double bytes_factor; ///< of unknowns times those in a slice, where it is factorised
      double
        bytes_coupled; ///< of an entry of the tangent besides, of bodies in a fluid: jet_two_sheets
      double entry;    ///< of all iterations of Newton's method [s]
      double factor;   ///< of the work of a factorisation, likewise [s]
      double coupled_cell; ///< of a cell around bodies, solving together: jet_two_sheets [s]
      /// Of an entry of the tangent besides, solving together: fitted, with Grid::cut_coupled,
      /// Grid::contact and implicit_cut, to the logarithms of what the scenes of prm/ and prm/hard
      /// cost by tests/scenes/costs.csv. [s]
      double coupled_entry;
    };
    constexpr Solid solid{58, 24, 60, 0.45e-6, 4e-10, 1e-6, 0.57e-6};

    /// Particles on the host, by particles_benchmark on one core, 7992 to 1052600 particles: what
    /// one takes in memory in single precision and in all of a sub-step; in double precision the
    /// engine takes more memory, and as long.
    struct Particles
    {
      double bytes_state; ///< in the model, the state and its copies: runs less the benchmark
      double bytes;       ///< in the engine
      double multigrid;   ///< besides, if there are as many as it is used for
      double bytes_solid; ///< besides, of a body's particle
      double bytes_cell;  ///< of the grid for neighbours
      double sub_step;    ///< with fluid [s]
      double elastic;     ///< of a body's particle in an elastic step [s]
    };
    constexpr double                   double_precision = 2.3; ///< 45360 particles
    constexpr std::array<Particles, 2> particles{
      {{500, 560, 100, 500, 24, 2.5e-6, 1e-6}, {500, 1270, 300, 2000, 24, 6e-6, 3e-6}}};
    constexpr double multigrid_from = 100000; ///< particles

    /// Files [bytes]: sizes of those of the same runs.
    constexpr double picture_value    = 10; ///< of a value in a cell
    constexpr double picture_unknown  = 25; ///< of a component of a body's velocity
    constexpr double picture_particle = 40;
  } // namespace cost_figures
} // namespace undine

#endif
