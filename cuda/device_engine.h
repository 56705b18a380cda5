// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_cuda_device_engine_h
#define undine_cuda_device_engine_h

#include <undine/particles/engine/engine.h>

namespace undine::particles
{
  /// An engine on the device of this number, from 0 on. Throws InputError if there is none.
  template <int dim, class Real>
  std::unique_ptr<Engine<dim>>
  make_device_engine(unsigned int device);
} // namespace undine::particles

#endif
