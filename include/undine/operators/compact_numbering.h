// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_operators_compact_numbering_h
#define undine_operators_compact_numbering_h

#include <deal.II/base/array_view.h>

#include <vector>

namespace undine
{
  /// The numbers k of 0, 1, ..., n - 1 for which is_kept(k), in ascending order.
  class CompactNumbering
  {
  public:
    /// `n`: how many numbers there are.
    template <class Predicate>
    CompactNumbering(const int n, const Predicate &is_kept)
    {
      for (int number = 0; number < n; ++number)
        {
          n_below.push_back(kept.size());
          if (is_kept(number))
            kept.push_back(number);
        }
      n_below.push_back(kept.size());
    }

    /// The kept numbers from `begin` to before `end`, 0 <= begin <= end <= n.
    dealii::ArrayView<const int>
    between(const int begin, const int end) const
    {
      return {kept.data() + n_below[begin], std::size_t(n_below[end] - n_below[begin])};
    }

  private:
    std::vector<int> kept, n_below;
  };
} // namespace undine

#endif
