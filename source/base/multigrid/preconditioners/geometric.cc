// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/core/registry.h>
#include <undine/base/multigrid/cell_preconditioner.h>
#include <undine/base/multigrid/geometric_multigrid.h>

namespace undine
{
  namespace
  {
    class Geometric : public CellPreconditioner
    {
    public:
      void
      initialize(const Matrix          &diffusion,
                 const Matrix          &whole,
                 const CellsOfUnknowns &places) override
      {
        multigrid = std::make_unique<const GeometricMultigrid>(diffusion, whole, places);
      }

      void
      vmult(Vector &x, const Vector &b) const override
      {
        multigrid->vmult(x, b);
      }

      std::size_t
      memory_consumption() const override
      {
        return multigrid ? multigrid->memory_consumption() : 0;
      }

    private:
      std::unique_ptr<const GeometricMultigrid> multigrid;
    };


    const Register<CellPreconditioner, Geometric>
      geometric("geometric", "Blocks of cells, divided where bodies divide them.");
  } // namespace
} // namespace undine
