// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/coupled/linear/block_system.h>

#include <EpetraExt_MatrixMatrix.h>
#include <EpetraExt_Transpose_RowMatrix.h>
#include <Epetra_Vector.h>

#include <cmath>
#include <memory>

namespace undine
{
  BlockSystem::BlockSystem(const Matrix &tangent,
                           const Matrix &flux,
                           const double  flux_factor,
                           const Matrix &pressure)
    : A(tangent)
    , B(flux)
    , k(flux_factor)
    , hL(pressure)
  {
  }


  BlockSystem::BlockVector
  BlockSystem::vector() const
  {
    return BlockVector({A.locally_owned_range_indices(), hL.locally_owned_range_indices()},
                       hL.get_mpi_communicator());
  }


  void
  BlockSystem::vmult(BlockVector &result, const BlockVector &x) const
  {
    Vector product(result.block(0));
    A.vmult(result.block(0), x.block(0));
    B.Tvmult(product, x.block(1));
    result.block(0).add(-1., product);

    product.reinit(result.block(1), true);
    hL.vmult(result.block(1), x.block(1));
    B.vmult(product, x.block(0));
    result.block(1).add(k, product);
  }


  BlockSystem::Matrix
  BlockSystem::approximate_schur_complement() const
  {
    const Epetra_CrsMatrix &flux = B.trilinos_matrix();
    Epetra_Vector           inverse(A.trilinos_matrix().RowMap());
    A.trilinos_matrix().ExtractDiagonalCopy(inverse);
    for (int i = 0; i < inverse.MyLength(); ++i)
      inverse[i] = inverse[i] == 0 ? 0 : k / std::abs(inverse[i]);
    // Products with a transposed matrix take several times as long.
    EpetraExt::RowMatrix_Transpose transpose;
    auto                          &transposed =
      dynamic_cast<Epetra_CrsMatrix &>(transpose(const_cast<Epetra_CrsMatrix &>(flux)));
    transposed.LeftScale(inverse);

    Epetra_CrsMatrix product(Copy, flux.RowMap(), 0);
    EpetraExt::MatrixMatrix::Multiply(flux, false, transposed, false, product);
    Epetra_CrsMatrix *sum = nullptr;
    EpetraExt::MatrixMatrix::Add(product, false, 1., hL.trilinos_matrix(), false, 1., sum);
    const std::unique_ptr<Epetra_CrsMatrix> owner(sum);
    sum->FillComplete(flux.RowMap(), flux.RowMap());
    Matrix result;
    result.reinit(*sum);
    return result;
  }
} // namespace undine
