// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_scene_other_schemes_h
#define undine_scene_other_schemes_h

#include <undine/base/options/options.h>

namespace undine
{
  /// Throws InputError for the first key or section of a scene of particles that only a fluid on a
  /// grid or bodies of finite elements have, with what particles have in its place.
  void
  refuse_keys_of_other_schemes(const Options &scene);
} // namespace undine

#endif
