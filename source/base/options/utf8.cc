// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/options/utf8.h>

#include <boost/locale/utf.hpp>

namespace undine
{
  namespace
  {
    /// Call `take(character, code)` for each character of the text and `spoilt()` for each byte
    /// that belongs to none.
    template <class Take, class Spoilt>
    void
    for_each_character(const std::string &text, const Take &take, const Spoilt &spoilt)
    {
      using namespace boost::locale::utf;
      for (auto begin = text.begin(); begin != text.end();)
        {
          auto       end  = begin;
          const auto code = utf_traits<char>::decode(end, text.end());
          if (code == illegal || code == incomplete)
            {
              spoilt();
              ++begin;
              continue;
            }
          take(std::string(begin, end), code);
          begin = end;
        }
    }
  } // namespace


  bool
  is_utf8(const std::string &text)
  {
    bool result = true;
    for_each_character(
      text, [](const auto &, const auto) {}, [&] { result = false; });
    return result;
  }


  std::string
  valid_utf8(const std::string &text)
  {
    std::string result;
    for_each_character(
      text,
      [&](const std::string &character, const auto) { result += character; },
      [&] { result += "\xEF\xBF\xBD"; });
    return result;
  }


  std::string
  printable(const std::string &text)
  {
    std::string result;
    for_each_character(
      text,
      [&](const std::string &character, const auto code) {
        const bool controls = (code < 0x20 && code != '\n') || (code >= 0x7f && code < 0xa0);
        result += controls ? "?" : character;
      },
      [&] { result += '?'; });
    return result;
  }
} // namespace undine
