// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_tests_message_of_h
#define undine_tests_message_of_h

#include <undine/base/core/errors.h>

#include <string>

namespace undine_tests
{
  /// What an action's InputError, SolveError or FileError says.
  template <class Action>
  std::string
  message_of(const Action &action)
  {
    try
      {
        action();
      }
    catch (const undine::Error &error)
      {
        return error.what();
      }
    return "no error";
  }
} // namespace undine_tests

#endif
