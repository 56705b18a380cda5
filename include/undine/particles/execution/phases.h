// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_particles_execution_phases_h
#define undine_particles_execution_phases_h

namespace undine::particles
{
  /// What a sub-step spends its time on.
  enum class Phase
  {
    forces,     ///< explicit ones: friction, gravity, collisions
    bodies,     ///< elastic steps
    sort,       ///< by cells
    neighbours, ///< finding them
    assembly,   ///< neighbourhoods, matrix, right-hand sides
    faces,      ///< solving for the potentials of the virtual faces
    multigrid,  ///< building its levels
    pressure,   ///< solving for the pressures
    correction, ///< by the pressures
    other,
    count
  };

  inline const char *
  name_of(const Phase phase)
  {
    constexpr const char *names[] = {"explicit forces",
                                     "elastic steps",
                                     "sorting",
                                     "neighbours",
                                     "assembly",
                                     "virtual faces",
                                     "multigrid levels",
                                     "pressure equation",
                                     "pressure correction",
                                     "other"};
    return names[static_cast<int>(phase)];
  }
} // namespace undine::particles

#endif
