// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_base_core_interruption_h
#define undine_base_core_interruption_h

#include <undine/base/core/errors.h>

#include <string>

namespace undine
{
  /// A run is stopped because the user (Ctrl-C) or a batch system asks for it. A step that is under
  /// way is abandoned; the state before it is kept.
  class Interruption : public Error
  {
  public:
    using Error::Error;

    int
    exit_code() const override
    {
      return 7;
    }
  };

  /// From now on SIGINT, SIGTERM and SIGUSR1, which batch systems and mpirun can pass on, only ask
  /// the run to stop. One that comes a second or more after the first ends the process at once, as
  /// if nobody listened, unless it is the launcher's answer to the first.
  void
  listen_for_interruption();

  /// Has this process been asked to stop? Ranks are asked at different moments: see
  /// throw_if_interrupted().
  bool
  interruption_requested();

  /// "SIGTERM", or "" if nothing was asked.
  std::string
  interruption_name();
} // namespace undine

#endif
