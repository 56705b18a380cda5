// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_base_options_options_output_h
#define undine_base_options_options_output_h

#include <undine/base/options/options.h>

#include <iosfwd>

namespace undine
{
  /// Everything that the parts of a scene have read, as a parameter file that gives the same run.
  void
  write_prm(std::ostream &out, const Options &options);

  /// The same as JSON.
  void
  write_json(std::ostream &out, const Options &options);

  /// All entries with unit, range, default and help, as Markdown.
  void
  write_reference(std::ostream &out, const Options &options);

  /// The same of sections whose path has these names next to each other, whatever their case
  /// ("output/vtu", "viscosity"), and of sections in them. Is there one?
  bool
  write_reference_of(std::ostream &out, const Options &options, const std::string &names);
} // namespace undine

#endif
