// SPDX-License-Identifier: LGPL-2.1-or-later
#include "device_engine.h"
#include "find_device.h"

namespace undine::particles
{
  /// Makes engines that work on a CUDA device.
  template <int dim>
  class DeviceEngineFactory : public EngineFactory<dim>
  {
  public:
    std::string
    reason_not_available() const
    {
      return reason_without_device();
    }

    std::unique_ptr<Engine<dim>>
    make(const Precision precision) const override
    {
      return precision == Precision::single_precision ? make_device_engine<dim, float>()
                                                      : make_device_engine<dim, double>();
    }
  };

  namespace
  {
    const RegisterForDimensions<EngineFactory, DeviceEngineFactory>
      device("device", "an NVIDIA graphics processor");
  } // namespace
} // namespace undine::particles
