// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/coupled/immersed/node_masses.h>
#include <undine/solid/assembly/mass_matrix.h>

#include <limits>

namespace undine
{
  template <int dim>
  std::vector<dealii::Tensor<1, dim>>
  node_masses(const Models<dim> &models)
  {
    if (!models.solid)
      return {};
    const auto &solid = *models.solid;
    auto        ones = solid.vector(), sums = solid.vector();
    ones = 1.;
    mass_matrix(solid).vmult(sums, ones);
    sums *= 1. / 3; // to the shortest waves along an edge M is as heavy as that
    if (solid.numerics().integrator->coefficients(1.).mass == 0) // static
      sums = std::numeric_limits<double>::infinity();
    for (const auto &fixed : solid.fixed())
      sums(fixed.dof) = std::numeric_limits<double>::infinity();
    sums.compress(dealii::VectorOperation::insert);
    // Nodes of bodies that sleep do not move.
    dealii::Tensor<1, dim> immovable;
    for (unsigned int axis = 0; axis < dim; ++axis)
      immovable[axis] = std::numeric_limits<double>::infinity();
    auto result = models.surface->with_bodies(
      sums, std::vector<dealii::Tensor<1, dim>>(models.surface->surface().n_nodes()));
    result.resize(models.surface->n_body_nodes());
    for (unsigned int node = 0; node < result.size(); ++node)
      if (!models.surface->moves(node))
        result[node] = immovable;
    return result;
  }


  template std::vector<dealii::Tensor<1, 2>>
  node_masses(const Models<2> &);
  template std::vector<dealii::Tensor<1, 3>>
  node_masses(const Models<3> &);
} // namespace undine
