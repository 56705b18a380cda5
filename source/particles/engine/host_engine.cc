// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/particles/engine/particle_engine.h>
#include <undine/particles/execution/host_executor.h>

namespace undine::particles
{
  /// Makes engines that work on the threads of the host.
  template <int dim>
  class HostEngineFactory : public EngineFactory<dim>
  {
  public:
    std::string
    reason_not_available(unsigned int) const override
    {
      return "";
    }

    std::unique_ptr<Engine<dim>>
    make(const Precision precision, unsigned int) const override
    {
      auto executor = std::make_unique<HostExecutor>(0);
      if (precision == Precision::single_precision)
        return make_particle_engine<HostExecutor, dim, float>(std::move(executor));
      return make_particle_engine<HostExecutor, dim, double>(std::move(executor));
    }
  };

  namespace
  {
    const RegisterForDimensions<EngineFactory, HostEngineFactory>
      host("host", "the threads of this machine's processors");
  } // namespace
} // namespace undine::particles
