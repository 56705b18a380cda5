// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/coupled/state/impulses.h>

namespace undine
{
  template <int dim>
  void
  Impulse<dim>::add(const Stage &stage, const Vectors &forces, const Vectors &kept)
  {
    if (rates.empty())
      rates.push_back(kept);
    const auto act = [this](const double duration, const Vectors &force) {
      for (std::size_t body = 0; body < sum.size(); ++body)
        sum[body] += duration * force[body];
    };
    for (std::size_t j = 0; j < stage.earlier.size(); ++j)
      act(stage.earlier[j].length, rates[j]);
    act(stage.length, forces);
    if (stage.is_last)
      rates.clear();
    rates.push_back(kept);
  }


  template class Impulse<2>;
  template class Impulse<3>;
} // namespace undine
