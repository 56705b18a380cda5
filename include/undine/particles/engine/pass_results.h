// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_particles_engine_pass_results_h
#define undine_particles_engine_pass_results_h

#include <undine/particles/elasticity/elastic_bodies.h>
#include <undine/particles/execution/buffer.h>
#include <undine/particles/fluid/stored_correction.h>
#include <undine/particles/math/matrix.h>
#include <undine/particles/model/particle.h>

#include <string>
#include <vector>

namespace undine::particles
{
  /// What a pass of the last sub-step computed, in the order of identities: those of all particles,
  /// or those of bodies.
  struct PassResult
  {
    std::string         name;
    std::vector<double> values; ///< as many for each particle
  };

  /// The numbers in an object, without what pads it. @{
  template <int dim, class Real>
  std::vector<double>
  numbers_in(const Vector<dim, Real> &vector)
  {
    return {vector.entries, vector.entries + dim};
  }

  template <int dim, class Real>
  std::vector<double>
  numbers_in(const StoredVector<dim, Real> &vector)
  {
    return {vector.entries, vector.entries + dim};
  }

  template <int dim, class Real>
  std::vector<double>
  numbers_in(const StoredCorrection<dim, Real> &correction)
  {
    const auto matrix = correction.matrix();
    return {matrix.entries, matrix.entries + matrix.size};
  }
  /// @}

  /// The numbers that `part` takes out of the entries of a buffer. `identities` says whose they
  /// are; empty: they are in order already.
  template <class Executor, class T, class Part>
  PassResult
  pass_result(const std::string         &name,
              const Buffer<Executor, T> &buffer,
              const std::vector<int>    &identities,
              const Part                &part)
  {
    const std::vector<T> entries = buffer.values();
    std::vector<T>       ordered = entries;
    for (std::size_t i = 0; i < identities.size(); ++i)
      ordered[identities[i]] = entries[i];
    PassResult result{name, {}};
    for (const T &entry : ordered)
      {
        const std::vector<double> numbers = part(entry);
        result.values.insert(result.values.end(), numbers.begin(), numbers.end());
      }
    return result;
  }

  /// In the order of the passes. `before` are the particles before the last pass moved them.
  template <class Particles, class Equation, class Bodies>
  std::vector<PassResult>
  pass_results(const Particles &now,
               const Particles &before,
               const Equation  &equation,
               const Bodies    &bodies)
  {
    const auto identities = now.identities.values();
    const auto of_all     = [&](const char *name, const auto &buffer, const auto &part) {
      return pass_result(name, buffer, identities, part);
    };
    const auto number   = [](const auto x) { return std::vector<double>{x}; };
    const auto tensor   = [](const auto &x) { return numbers_in(x); };
    const auto velocity = [](const auto &x) { return numbers_in(x.v); };
    const auto pressure = [](const auto &x) { return std::vector<double>{x.pressure}; };
    return {of_all("velocity without pressure", before.motions, velocity),
            of_all("number density", equation.densities, number),
            of_all("correction of gradients", equation.corrections, tensor),
            of_all("gaps between faces", equation.gaps, tensor),
            of_all("potentials of faces", now.potentials, tensor),
            of_all("diagonal", equation.diagonal, number),
            of_all("source", equation.right_hand_side, number),
            of_all("pressure", now.motions, pressure),
            of_all("velocity", now.motions, velocity),
            pass_result("accelerations by pressure", bodies.accelerations, {}, tensor),
            pass_result("velocity of bodies", bodies.points, {}, velocity)};
  }
} // namespace undine::particles

#endif
