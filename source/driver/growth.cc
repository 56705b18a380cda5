// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/driver/growth.h>

#include <fmt/format.h>

namespace undine
{
  std::string
  Growth::text() const
  {
    return fmt::format("{}, {}, its {} by a factor of {:.4g} a step", where, mode, what, factor);
  }
} // namespace undine
