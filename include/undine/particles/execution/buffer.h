// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_particles_execution_buffer_h
#define undine_particles_execution_buffer_h

#include <cstddef>
#include <utility>
#include <vector>

namespace undine::particles
{
  /// An array where an executor works. The executor must outlive it.
  template <class Executor, class T>
  class Buffer
  {
  public:
    Buffer(const Executor &executor, const std::size_t n)
      : executor(&executor)
      , memory(executor.template allocate<T>(n))
      , n(n)
    {
    }

    Buffer(const Executor &executor, const std::vector<T> &values)
      : Buffer(executor, values.size())
    {
      executor.upload(memory, values.data(), n);
    }

    Buffer(Buffer &&other) noexcept
      : executor(other.executor)
      , memory(std::exchange(other.memory, nullptr))
      , n(std::exchange(other.n, 0))
    {
    }

    Buffer &
    operator=(Buffer &&other) noexcept
    {
      std::swap(executor, other.executor);
      std::swap(memory, other.memory);
      std::swap(n, other.n);
      return *this;
    }

    ~Buffer()
    {
      if (memory != nullptr)
        executor->release(memory);
    }

    T *
    data() const
    {
      return memory;
    }

    std::size_t
    size() const
    {
      return n;
    }

    std::vector<T>
    values() const
    {
      std::vector<T> result(n);
      executor->download(result.data(), memory, n);
      return result;
    }

    void
    set(const std::vector<T> &values)
    {
      executor->upload(memory, values.data(), values.size());
    }

    void
    clear()
    {
      executor->clear(memory, n);
    }

  private:
    const Executor *executor;
    T              *memory;
    std::size_t     n;
  };
} // namespace undine::particles

#endif
