// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_base_core_interruption_h
#define undine_base_core_interruption_h

#include <undine/base/core/errors.h>

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
} // namespace undine

#endif
