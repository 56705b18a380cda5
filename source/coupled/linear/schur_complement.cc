// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/core/registry.h>
#include <undine/coupled/linear/schur_complement.h>

namespace undine
{
  SchurComplement::SchurComplement(const BlockSystem     &system,
                                   const CellsOfUnknowns &places,
                                   const std::string     &multigrid)
    : inverse(Registry<CellPreconditioner>::instance().make(multigrid))
  {
    S.copy_from(system.approximate_schur_complement());
    inverse->initialize(system.pressure(), S, places);
  }


  std::size_t
  SchurComplement::memory_consumption() const
  {
    return S.memory_consumption() + inverse->memory_consumption();
  }
} // namespace undine
