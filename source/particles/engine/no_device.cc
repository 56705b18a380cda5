// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/particles/engine/engine.h>

namespace undine::particles
{
  /// Stands in for the engine on graphics processors in a program without it.
  template <int dim>
  class NoDeviceFactory : public EngineFactory<dim>
  {
  public:
    std::string
    reason_not_available(unsigned int) const override
    {
      return "this program was built without CUDA, so the executor 'device' is not in it. Choose "
             "the executor 'host', or install the CUDA toolkit (nvcc) and configure again.";
    }

    std::unique_ptr<Engine<dim>>
    make(const Precision, const unsigned int number) const override
    {
      throw InputError(reason_not_available(number));
    }
  };

  namespace
  {
    const RegisterForDimensions<EngineFactory, NoDeviceFactory>
      device("device",
             "an NVIDIA graphics processor; not in this program, which was built without CUDA");
  } // namespace
} // namespace undine::particles
