// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_scene_other_schemes_h
#define undine_scene_other_schemes_h

#include <undine/base/options/options.h>

namespace undine
{
  /// Notes a mistake for every key or section of a scene of particles that describes what only a
  /// fluid on a grid or bodies of finite elements can do or show, with what particles have in its
  /// place (Options::mistake()).
  void
  refuse_keys_of_other_schemes(const Options &scene);

  /// The same of a scene of another scheme, for what only particles can do.
  void
  refuse_keys_of_particles(const Options &scene);

  /// Keys and sections that say how finely and by which solvers another method computes, so that
  /// one file may have the numbers of several: they are no mistakes. Returns a note for each.
  std::vector<std::string>
  skip_numbers_of_other_methods(const Options &scene, bool has_particles);
} // namespace undine

#endif
