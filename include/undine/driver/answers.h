// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_driver_answers_h
#define undine_driver_answers_h

#include <undine/driver/command_line.h>

namespace undine
{
  /// Answer on the standard output what needs no scene to be built: the reference of parameters,
  /// those of a scene or of a study, values of an expression. On one rank. Throws InputError.
  void
  answer(const Request &request);
} // namespace undine

#endif
