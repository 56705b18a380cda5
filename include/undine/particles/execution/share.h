// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_particles_execution_share_h
#define undine_particles_execution_share_h

namespace undine::particles
{
  /// A worker's part of some indices: begin ... end - 1.
  struct Share
  {
    int begin, end;
  };
} // namespace undine::particles

#endif
