// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/particles/setup/disorder.h>

#include <random>

namespace undine::particles
{
  template <int dim>
  void
  disorder(const Setup<dim> &setup, ParticleState<dim> &state)
  {
    if (!setup.is_full)
      return;
    constexpr double share = 0.1; // of the spacing
    std::mt19937     random;      // the same numbers everywhere, unlike distributions
    for (std::size_t i = 0; i < state.tags.size(); ++i)
      if (state.tags[i].kind() == Kind::fluid)
        for (int axis = 0; axis < dim; ++axis)
          state.positions[i][axis] +=
            share * setup.spacing * (2. * random() / std::mt19937::max() - 1);
  }


  template void
  disorder(const Setup<2> &, ParticleState<2> &);
  template void
  disorder(const Setup<3> &, ParticleState<3> &);
} // namespace undine::particles
