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
    reason_not_available(const unsigned int device) const override
    {
      return reason_without_device(device);
    }

    std::unique_ptr<Engine<dim>>
    make(const Precision precision, const unsigned int device) const override
    {
      return precision == Precision::single_precision ? make_device_engine<dim, float>(device)
                                                      : make_device_engine<dim, double>(device);
    }
  };

  namespace
  {
    const RegisterForDimensions<EngineFactory, DeviceEngineFactory>
      registered("device", "an NVIDIA graphics processor");
  } // namespace
} // namespace undine::particles
