// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/core/registry.h>
#include <undine/base/multigrid/cell_preconditioner.h>
#include <undine/base/parallel/algebraic_multigrid.h>

namespace undine
{
  namespace
  {
    class Algebraic : public CellPreconditioner
    {
    public:
      void
      initialize(const Matrix &, const Matrix &whole, const CellsOfUnknowns &) override
      {
        multigrid.initialize(whole);
      }

      void
      vmult(Vector &x, const Vector &b) const override
      {
        multigrid.vmult(x, b);
      }

      std::size_t
      memory_consumption() const override
      {
        return multigrid.memory_consumption();
      }

    private:
      AlgebraicMultigrid multigrid;
    };


    const Register<CellPreconditioner, Algebraic> algebraic("algebraic",
                                                            "Smoothed aggregation by Trilinos ML.");
  } // namespace
} // namespace undine
