// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_driver_json_text_h
#define undine_driver_json_text_h

#include <undine/base/options/utf8.h>

#include <fmt/format.h>

#include <cmath>
#include <string>

namespace undine
{
  /// The text as a string of JSON; line breaks become blanks.
  inline std::string
  quoted(const std::string &text)
  {
    std::string result = "\"";
    for (const char c : valid_utf8(text))
      if (c == '"' || c == '\\')
        result += std::string("\\") + c;
      else
        result += static_cast<unsigned char>(c) < ' ' ? ' ' : c;
    return result + "\"";
  }


  /// The number as JSON has it, which knows no infinity: null.
  inline std::string
  json_number(const double value)
  {
    return std::isfinite(value) ? fmt::format("{:.6g}", value) : "null";
  }


  /// A list of JSON, a line each, of what `write` makes of each item.
  template <class Items, class Write>
  std::string
  json_list(const Items &items, const Write &write)
  {
    std::string result;
    for (const auto &item : items)
      result += (result.empty() ? "\n    " : ",\n    ") + write(item);
    return "[" + result + "\n  ]";
  }
} // namespace undine

#endif
