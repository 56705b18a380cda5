// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_particles_execution_host_executor_h
#define undine_particles_execution_host_executor_h

#include <undine/particles/execution/lanes.h>
#include <undine/particles/execution/phases.h>
#include <undine/particles/execution/share.h>
#include <undine/particles/execution/sums.h>

#include <omp.h>

#include <algorithm>
#include <cstring>
#include <new>
#include <string>
#include <vector>

namespace undine::particles
{
  /// Works on a part of a pass while the others wait.
  struct LoneWorker
  {
    template <class Function>
    void
    for_each_spread(const int n, const Function &f) const
    {
      for (int i = 0; i < n; ++i)
        f(i);
    }

    template <class Function>
    void
    for_each_by_lanes(const int n, const Function &f) const
    {
      for (int i = 0; i < n; ++i)
        f(i, OneLane());
    }

    void
    sync() const
    {
    }
  };


  /// The threads that work on one pass together. A pass that needs several rounds with all of its
  /// workers waiting for each other in between is written as a function of a team; DeviceTeam in
  /// cuda/ has the same interface for the threads of one launch.
  class HostTeam
  {
  public:
    static constexpr int block     = 1024; ///< numbers summed one after the other
    static constexpr int most_sums = 8;    ///< taken together

    /// Room for the partial sums of one pass.
    struct Workspace
    {
      std::vector<Sums<most_sums>> partial[2];
    };

    HostTeam(const int rank, const int size, Workspace &workspace)
      : rank(rank)
      , size(size)
      , workspace(&workspace)
    {
    }

    /// Those of 0 ... n-1 that are this worker's; always the same ones for the same n. On the
    /// device those of a block, whose threads work on them together.
    Share
    share(const int n) const
    {
      const int each = (n + size - 1) / size;
      return {std::min(n, rank * each), std::min(n, (rank + 1) * each)};
    }

    /// f(i) for all i of a share.
    template <class Function>
    void
    for_each_of(const Share &share, const Function &f) const
    {
      for (int i = share.begin; i < share.end; ++i)
        f(i);
    }

    /// f(i, fetch(i)): what is fetched for several i is on the way together.
    template <class Fetch, class Function>
    void
    for_each_of(const Share &share, const Fetch &fetch, const Function &f) const
    {
      for (int i = share.begin; i < share.end; ++i)
        f(i, fetch(i));
    }

    /// Wait for those who work on the same share.
    void
    sync_own() const
    {
    }

    template <class Function>
    void
    for_each(const int n, const Function &f) const
    {
      for_each_of(share(n), f);
    }

    /// f(i, lanes): some lanes work on each i where there are more workers than that.
    template <class Function>
    void
    for_each_by_lanes(const int n, const Function &f) const
    {
      for_each(n, [&](const int i) { f(i, OneLane()); });
    }

    /// The same with neighbouring i for different workers, where few of them are any work.
    template <class Function>
    void
    for_each_spread(const int n, const Function &f) const
    {
      for_each(n, f);
    }

    /// f(team) by a few workers that need not wait long for each other; the others go on.
    template <class Function>
    void
    alone(const Function &f) const
    {
      if (rank != 0)
        return;
      LoneWorker worker;
      f(worker);
    }

    /// The sums that f(i, sums) adds to over all i of 0 ... n-1, for all workers, who wait for each
    /// other. Does not depend on the number of workers.
    template <int count, class Function>
    Sums<count>
    sum(const int n, const Function &f)
    {
      static_assert(count <= most_sums, "no room for so many sums");
      auto     &partial = workspace->partial[parity];
      const int blocks  = (n + block - 1) / block;
      for (int b = rank; b < blocks; b += size)
        {
          Sums<count> sums;
          for (int i = b * block; i < std::min(n, (b + 1) * block); ++i)
            f(i, sums);
          std::copy(sums.values, sums.values + count, partial[b].values);
        }
      sync();
      Sums<count> total;
      for (int b = 0; b < blocks; ++b)
        for (int k = 0; k < count; ++k)
          total[k] += partial[b][k];
      // Nobody writes to this half again before everybody has passed the next sync().
      parity = 1 - parity;
      return total;
    }

    /// The sums of all workers' parts, for all of them, who wait for each other: as sync(). Depends
    /// on their number by rounding.
    template <int count>
    Sums<count>
    total(const Sums<count> &mine)
    {
      static_assert(count <= most_sums, "no room for so many sums");
      auto &partial = workspace->partial[parity];
      std::copy(mine.values, mine.values + count, partial[rank].values);
      sync();
      Sums<count> total;
      for (int worker = 0; worker < size; ++worker)
        for (int k = 0; k < count; ++k)
          total[k] += partial[worker][k];
      parity = 1 - parity;
      return total;
    }

    /// Wait for all workers; what they wrote before is visible after.
    void
    sync() const
    {
      _Pragma("omp barrier")
    }

    bool
    is_first() const
    {
      return rank == 0;
    }

  private:
    int        rank, size;
    Workspace *workspace;
    int        parity = 0;
  };


  /// Runs passes on the threads of the host. DeviceExecutor in cuda/ has the same interface.
  class HostExecutor
  {
  public:
    using Team = HostTeam;

    /// Particles.
    static constexpr int multigrid_pays_from = 100000;
    static constexpr int room_pays_from      = 0;

    /// `threads` = 0: as many as OpenMP gives, all cores unless OMP_NUM_THREADS says otherwise.
    explicit HostExecutor(const int threads)
    {
      set_threads(threads);
    }

    void
    set_threads(const int number)
    {
      threads = number > 0 ? number : omp_get_max_threads();
    }

    std::string
    describe() const
    {
      return std::to_string(threads) + (threads == 1 ? " thread" : " threads") + " of the host";
    }

    /// Memory for n objects, all bytes zero.
    template <class T>
    T *
    allocate(const std::size_t n) const
    {
      auto memory = ::operator new(n * sizeof(T), std::align_val_t(64));
      std::memset(static_cast<void *>(memory), 0, n * sizeof(T));
      return static_cast<T *>(memory);
    }

    template <class T>
    void
    release(T *memory) const
    {
      ::operator delete(memory, std::align_val_t(64));
    }

    template <class T>
    void
    upload(T *to, const T *from, const std::size_t n) const
    {
      if (n > 0)
        std::memcpy(to, from, n * sizeof(T));
    }

    template <class T>
    void
    download(T *to, const T *from, const std::size_t n) const
    {
      upload(to, from, n);
    }

    template <class T>
    void
    clear(T *memory, const std::size_t n) const
    {
      std::memset(static_cast<void *>(memory), 0, n * sizeof(T));
    }

    /// Within the host.
    template <class T>
    void
    duplicate(T *to, const T *from, const std::size_t n) const
    {
      upload(to, from, n);
    }

    /// f(i) for all i of 0 ... n-1, in any order.
    template <class Function>
    void
    for_each(const int n, const Function &f) const
    {
      _Pragma("omp parallel for num_threads(threads) schedule(dynamic, 256)") //
        for (int i = 0; i < n; ++i) f(i);
    }

    /// f(i, room) where room[k] is memory for `size` numbers that f may use.
    template <int size, class Number, class Function>
    void
    for_each_with_room(const int n, const Function &f) const
    {
      for_each(n, [&](const int i) {
        Number room[size];
        f(i, room);
      });
    }

    /// f(team) by all workers at once; loops in it go up to `n`.
    template <class Function>
    void
    run(const int n, const Function &f)
    {
      const std::size_t parts = std::max(n / HostTeam::block + 1, threads);
      for (auto &partial : workspace.partial)
        if (partial.size() < parts)
          partial.resize(parts);
      _Pragma("omp parallel num_threads(threads)")
      {
        HostTeam team(omp_get_thread_num(), omp_get_num_threads(), workspace);
        f(team);
      }
    }

    /// The same where most loops are for_each_by_lanes().
    template <class Function>
    void
    run_by_lanes(const int n, const Function &f)
    {
      run(n, f);
    }

    /// out[i] = in[0] + ... + in[i-1] for i = 0 ... n-1.
    void
    exclusive_scan(const int n, const int *in, int *out) const
    {
      int sum = 0;
      for (int i = 0; i < n; ++i)
        {
          const int value = in[i];
          out[i]          = sum;
          sum += value;
        }
    }

    /// All passes are done.
    void
    wait() const
    {
    }

    /// Time phases from now on.
    void
    time_phases()
    {
      phase = Phase::other;
      since = omp_get_wtime();
    }

    /// The phase before this one ends here.
    void
    enter(const Phase next)
    {
      if (phase == Phase::count)
        return;
      const double now = omp_get_wtime();
      sums[static_cast<int>(phase)] += now - since;
      since = now;
      phase = next;
    }

    /// Of a phase since time_phases() [s].
    double
    seconds(const Phase which) const
    {
      return sums[static_cast<int>(which)];
    }

  private:
    int                 threads;
    HostTeam::Workspace workspace;

    Phase  phase                                = Phase::count; ///< count: not timed
    double since                                = 0;            ///< [s]
    double sums[static_cast<int>(Phase::count)] = {};
  };
} // namespace undine::particles

#endif
