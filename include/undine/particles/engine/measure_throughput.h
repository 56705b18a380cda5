// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_particles_engine_measure_throughput_h
#define undine_particles_engine_measure_throughput_h

#include <undine/particles/engine/engine.h>
#include <undine/particles/execution/buffer.h>
#include <undine/particles/pressure/conjugate_gradients.h>

#include <chrono>

namespace undine::particles
{
  /// The product of a system's matrix with its solution, again and again, as solvers take it.
  template <class Real, class Entry>
  struct RepeatProduct
  {
    LinearSystem<Real, Entry, Real> system;
    Real                           *result;
    int                             repetitions;

    template <class Team>
    UNDINE_HOST_DEVICE
    void
    operator()(Team &team) const
    {
      for (int k = 0; k < repetitions; ++k)
        team.template sum<1>(system.matrix.n, [&](const int i, Sums<1> &sums) {
          result[i] = system.row_times(i, system.solution);
          sums[0] += result[i];
        });
    }
  };


  /// Measures RepeatProduct and copies of memory, after both have been tried.
  template <class Executor, class Real, class Entry>
  class ThroughputMeasurement
  {
  public:
    explicit ThroughputMeasurement(Executor &executor)
      : executor(executor)
    {
    }

    /// Changes `product.result` only.
    Throughput
    operator()(RepeatProduct<Real, Entry> product) const
    {
      constexpr int           repetitions = 50;
      constexpr int           large       = 1 << 26; ///< numbers: more than caches hold
      Buffer<Executor, float> from(executor, large), to(executor, large);
      Throughput              result;
      product.repetitions = repetitions;
      result.product      = repetitions * bytes(product.system) /
                       seconds([&]() { executor.run(product.system.matrix.n, product); });
      result.copy = repetitions * 2. * large * sizeof(float) / seconds([&]() {
                      for (int k = 0; k < repetitions; ++k)
                        executor.duplicate(to.data(), from.data(), large);
                    });
      return result;
    }

  private:
    /// What a product cannot do without: each entry, diagonal, number and result once.
    double
    bytes(const LinearSystem<Real, Entry, Real> &system) const
    {
      const auto      &matrix = system.matrix;
      std::vector<int> counts(matrix.n);
      executor.download(counts.data(), matrix.counts, matrix.n);
      double entries = 0;
      for (const int count : counts)
        entries += count;
      return entries * sizeof(Entry) + matrix.n * (sizeof(int) + 3. * sizeof(Real));
    }

    template <class Function>
    double
    seconds(const Function &f) const
    {
      f();
      executor.wait();
      const auto begin = std::chrono::steady_clock::now();
      f();
      executor.wait();
      return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    }

    Executor &executor;
  };
} // namespace undine::particles

#endif
