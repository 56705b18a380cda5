// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_benchmarks_particles_check_run_h
#define undine_benchmarks_particles_check_run_h

#include "dam_break.h"

#include <undine/particles/engine/engine.h>

namespace undine::particles
{
  /// What is known of a run when its timing is over.
  struct TimedRun
  {
    double       time          = 0; ///< since the dam broke [s]
    double       energy_before = 0; ///< when the timing began [J]
    unsigned int not_converged = 0; ///< pressure equations
  };

  /// Of fluid, bodies and gravity [J].
  double
  energy_of(const Balance<3> &balance);

  /// Prints the state at the end of what was timed, and what is wrong with it: particles outside,
  /// energy that has grown, equations that were not solved, water in the sphere or a sphere of
  /// another volume (by 5 %), or, without a sphere, a front that is not from 5 % behind to 20 %
  /// ahead of the experiment of Koshizuka and Oka [1996] (whose gate takes time to open). False if
  /// there is anything.
  bool
  is_plausible(const DamBreak &dam, const Engine<3> &engine, const TimedRun &run);
} // namespace undine::particles

#endif
