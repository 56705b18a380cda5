// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_base_options_utf8_h
#define undine_base_options_utf8_h

#include <string>

namespace undine
{
  bool
  is_utf8(const std::string &text);

  /// The same with U+FFFD, the replacement character, for every byte that belongs to no character.
  std::string
  valid_utf8(const std::string &text);

  /// For a terminal, to which bytes may be commands: control characters but ends of lines, and
  /// bytes that belong to no character, are replaced by '?'.
  std::string
  printable(const std::string &text);
} // namespace undine

#endif
