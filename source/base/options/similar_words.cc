// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/options/similar_words.h>

#include <algorithm>
#include <cctype>
#include <numeric>

namespace undine
{
  namespace
  {
    unsigned int
    distance(const std::string &a, const std::string &b)
    {
      const auto lower = [](const char c) { return std::tolower(static_cast<unsigned char>(c)); };
      std::vector<unsigned int> row(b.size() + 1);
      std::iota(row.begin(), row.end(), 0);
      for (std::size_t i = 1; i <= a.size(); ++i)
        {
          unsigned int diagonal = row[0];
          row[0]                = i;
          for (std::size_t j = 1; j <= b.size(); ++j)
            {
              const unsigned int above   = row[j];
              const bool         differs = lower(a[i - 1]) != lower(b[j - 1]);
              row[j]   = std::min({above + 1, row[j - 1] + 1, diagonal + (differs ? 1 : 0)});
              diagonal = above;
            }
        }
      return row.back();
    }


    void
    sort_by_distance(std::vector<std::string> &known, const std::string &word)
    {
      std::stable_sort(known.begin(), known.end(), [&](const auto &a, const auto &b) {
        return distance(a, word) < distance(b, word);
      });
    }
  } // namespace


  std::string
  did_you_mean(const std::vector<std::string> &known, const std::string &word)
  {
    auto sorted = known;
    sort_by_distance(sorted, word);
    const std::size_t near = std::max<std::size_t>(1, (word.size() + 1) / 3);
    return !sorted.empty() && distance(sorted.front(), word) <= near
             ? "Did you mean '" + sorted.front() + "'?"
             : "";
  }


  std::string
  most_similar_first(std::vector<std::string> known, const std::string &word)
  {
    sort_by_distance(known, word);
    std::string list;
    for (const auto &name : known)
      list += (list.empty() ? "'" : ", '") + name + "'";
    return list;
  }
} // namespace undine
