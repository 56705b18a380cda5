// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_scene_measure_particles_h
#define undine_scene_measure_particles_h

#include <undine/scene/scene_size.h>

namespace undine
{
  /// The number of particles of a scene of the scheme 'particle', and of sub-steps of a frame. The
  /// region of the fluid is evaluated at a sample of places; no particle is made. Throws
  /// InputError, FileError.
  template <int dim>
  ParticleSize
  measure_particles(const Options &scene);
} // namespace undine

#endif
