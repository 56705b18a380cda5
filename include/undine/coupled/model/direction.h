// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_coupled_model_direction_h
#define undine_coupled_model_direction_h

#include <undine/base/options/options.h>

namespace undine
{
  /// In which direction bodies and fluid act on each other: `Coupling / Direction`.
  enum class Direction
  {
    two_way,
    fluid_to_body, ///< the fluid flows around the bodies as they were at the start
    body_to_fluid  ///< the bodies move as if there were no fluid
  };

  /// Read the key. Throws InputError, also if it chooses a single direction in a scene that has not
  /// both a fluid and bodies, or against other keys of the section.
  Direction
  read_direction(const Options &scene);
} // namespace undine

#endif
