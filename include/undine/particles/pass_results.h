// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_particles_pass_results_h
#define undine_particles_pass_results_h

#include <undine/particles/buffer.h>
#include <undine/particles/state_transfer.h>

#include <string>
#include <vector>

namespace undine::particles
{
  /// What a pass of the last sub-step computed, in the order of identities: those of all particles,
  /// or those of bodies.
  struct PassResult
  {
    std::string         name;
    int                 components; ///< numbers for each particle
    std::vector<double> values;
  };

  /// `identities` says whose the entries of `buffer` are; empty: they are in order already.
  template <class Real, class Executor, class T>
  PassResult
  pass_result(const std::string         &name,
              const Buffer<Executor, T> &buffer,
              const std::vector<int>    &identities)
  {
    constexpr int components = sizeof(T) / sizeof(Real);
    PassResult    result{name, components, flattened<Real>(buffer.values())};
    if (identities.empty())
      return result;
    const std::vector<double> sorted = result.values;
    for (std::size_t i = 0; i < identities.size(); ++i)
      for (int k = 0; k < components; ++k)
        result.values[identities[i] * components + k] = sorted[i * components + k];
    return result;
  }

  /// In the order of the passes. `before` are the particles before the last pass moved them.
  template <class Real, class Particles, class Equation, class Bodies>
  std::vector<PassResult>
  pass_results(const Particles &now,
               const Particles &before,
               const Equation  &equation,
               const Bodies    &bodies)
  {
    const auto identities = now.identities.values();
    const auto of_all     = [&](const char *name, const auto &buffer) {
      return pass_result<Real>(name, buffer, identities);
    };
    return {of_all("velocity without pressure", before.motions),
            of_all("number density", equation.densities),
            of_all("correction of gradients", equation.corrections),
            of_all("gaps between faces", equation.gaps),
            of_all("potentials of faces", now.potentials),
            of_all("diagonal", equation.diagonal),
            of_all("source", equation.right_hand_side),
            of_all("velocity and pressure", now.motions),
            pass_result<Real>("accelerations by pressure", bodies.accelerations, {}),
            pass_result<Real>("bodies", bodies.points, {})};
  }
} // namespace undine::particles

#endif
