// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_solid_assembly_norms_by_body_h
#define undine_solid_assembly_norms_by_body_h

#include <undine/solid/mesh/solid_model.h>

#include <vector>

namespace undine
{
  /// l2 norms of nodal vectors, body by body: bodies may be of very different stiffness and size,
  /// and what is next to nothing for one of them is all that acts on another one.
  template <int dim>
  class NormsByBody
  {
  public:
    using Vector = typename SolidModel<dim>::Vector;

    explicit NormsByBody(const SolidModel<dim> &model);

    /// [bodies], in the unit of the vector, which is one over the locally owned degrees of freedom.
    /// Collective.
    std::vector<double>
    operator()(const Vector &nodal) const;

  private:
    MPI_Comm                  communicator;
    unsigned int              n_bodies;
    std::vector<unsigned int> body_of; ///< of the locally owned degrees of freedom, if there are
                                       ///< several bodies
  };
} // namespace undine

#endif
