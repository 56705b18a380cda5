// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_driver_study_file_h
#define undine_driver_study_file_h

#include <undine/base/options/options.h>

namespace undine
{
  /// Declare and read all keys of a study: a scene, what is varied in it, and the quantities whose
  /// errors are wanted. Mistakes are noted. The runs themselves are made by the scripts in
  /// `study/`, which read what write_json() makes of this.
  void
  read_study(const Options &options);
} // namespace undine

#endif
