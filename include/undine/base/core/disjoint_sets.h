// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_base_core_disjoint_sets_h
#define undine_base_core_disjoint_sets_h

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace undine
{
  /// Disjoint sets of whole numbers 0..n-1, each known by its smallest member.
  class DisjointSets
  {
  public:
    explicit DisjointSets(const std::size_t n)
      : parents(n)
    {
      std::iota(parents.begin(), parents.end(), std::size_t(0));
    }

    std::size_t
    smallest(std::size_t member)
    {
      while (parents[member] != member)
        member = parents[member] = parents[parents[member]];
      return member;
    }

    void
    join(const std::size_t a, const std::size_t b)
    {
      const auto first = smallest(a), second = smallest(b);
      parents[std::max(first, second)] = std::min(first, second);
    }

  private:
    std::vector<std::size_t> parents;
  };
} // namespace undine

#endif
