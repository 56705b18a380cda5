// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_base_options_old_names_h
#define undine_base_options_old_names_h

#include <string>

namespace undine
{
  /// The path that a key of an earlier version has today, such as "Output/Budget" for
  /// "Output/Ledger"; any other path as it is. A renamed key is one line of the table in the .cc
  /// file.
  std::string
  current_path(const std::string &path);
} // namespace undine

#endif
