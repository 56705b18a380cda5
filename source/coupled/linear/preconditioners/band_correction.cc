// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/core/registry.h>
#include <undine/coupled/linear/band_correction.h>

namespace undine
{
  namespace
  {
    /// The pressures of this rank at bodies and in `layers` layers of cells around them.
    dealii::IndexSet
    band_around_bodies(const BlockSystem &system, const unsigned int layers)
    {
      const auto         &hL    = system.pressure();
      const auto          owned = hL.locally_owned_range_indices();
      BlockSystem::Vector in_band(owned, hL.get_mpi_communicator()), next(in_band);
      for (const auto row : owned)
        in_band(row) = system.flux().row_length(row) > 0 ? 1 : 0;
      in_band.compress(dealii::VectorOperation::insert);
      for (unsigned int layer = 0; layer < layers; ++layer)
        {
          // All entries off the diagonal have one sign: outside, nothing but neighbours counts.
          hL.vmult(next, in_band);
          for (const auto row : owned)
            if (next(row) != 0)
              in_band(row) = 1;
          in_band.compress(dealii::VectorOperation::insert);
        }
      dealii::IndexSet result(owned.size());
      for (const auto row : owned)
        if (in_band(row) != 0)
          result.add_index(row);
      result.compress();
      return result;
    }
  } // namespace


  void
  BandCorrection::add_options(const Options &options)
  {
    triangular.add_options(options);
    options.add("Layers",
                layers,
                "",
                Allowed::between(0, 20),
                "Of cells around the bodies in which the equations are solved exactly.");
  }


  void
  BandCorrection::initialize(const BlockSystem     &new_system,
                             const SchurComplement &schur,
                             const ApplyInverse    &tangent_inverse)
  {
    system = &new_system;
    triangular.initialize(new_system, schur, tangent_inverse);
    band.factorise(new_system, band_around_bodies(new_system, layers));
  }


  void
  BandCorrection::vmult(BlockVector &result, const BlockVector &right_side) const
  {
    triangular.vmult(result, right_side);
    BlockVector rest(right_side);
    system->vmult(rest, result);
    rest.sadd(-1., 1., right_side);
    result.add(1., band.solve(rest));
  }


  static const Register<BlockPreconditioner, BandCorrection>
    band_correction("band correction",
                    "Block triangular, then exactly at the bodies and in a band of cells around.");
} // namespace undine
