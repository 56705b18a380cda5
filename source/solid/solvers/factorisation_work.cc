// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/solid/assembly/sums_by_body.h>
#include <undine/solid/solvers/factorisation_work.h>

#include <deal.II/base/bounding_box.h>
#include <deal.II/base/mpi.h>

#include <algorithm>
#include <limits>

namespace undine
{
  namespace
  {
    /// Elements of a body: how far they and the whole of them reach along the axes.
    template <int dim>
    struct Extents
    {
      double                 n_cells = 0;
      dealii::Tensor<1, dim> sum; ///< of those of the cells [m]
      dealii::Tensor<1, dim> lower, upper;
    };


    template <int dim>
    std::vector<Extents<dim>>
    extents_of_bodies(const SolidModel<dim> &model)
    {
      constexpr double far      = std::numeric_limits<double>::max();
      const auto      &geometry = model.geometry();
      Extents<dim>     empty;
      for (unsigned int axis = 0; axis < dim; ++axis)
        {
          empty.lower[axis] = far;
          empty.upper[axis] = -far;
        }
      std::vector<Extents<dim>> result(model.bodies().size(), empty);
      for (unsigned int cell = 0; cell < geometry.n_cells(); ++cell)
        {
          const auto box  = geometry.cell(cell)->bounding_box();
          auto      &body = result[geometry.body(cell)];
          body.n_cells += 1;
          for (unsigned int axis = 0; axis < dim; ++axis)
            {
              body.sum[axis] += box.side_length(axis);
              body.lower[axis] = std::min(body.lower[axis], box.lower_bound(axis));
              body.upper[axis] = std::max(body.upper[axis], box.upper_bound(axis));
            }
        }
      const auto communicator = model.communicator();
      for (auto &body : result)
        {
          body.n_cells = dealii::Utilities::MPI::sum(body.n_cells, communicator);
          body.sum     = dealii::Utilities::MPI::sum(body.sum, communicator);
          for (unsigned int axis = 0; axis < dim; ++axis)
            {
              body.lower[axis] = dealii::Utilities::MPI::min(body.lower[axis], communicator);
              body.upper[axis] = dealii::Utilities::MPI::max(body.upper[axis], communicator);
            }
        }
      return result;
    }
  } // namespace


  double
  most_work_of_factors(const FactorUse use, const bool with_dilatation)
  {
    return use == FactorUse::preconditioner ? 2e11 : with_dilatation ? 8e10 : 7e9;
  }


  template <int dim>
  double
  factorisation_work(const SolidModel<dim> &model)
  {
    auto ones         = model.vector();
    ones              = 1.;
    const auto n      = sums_by_body(model, ones);
    const auto at     = extents_of_bodies(model);
    double     result = 0;
    for (unsigned int body = 0; body < n.size(); ++body)
      {
        double slices = 1;
        for (unsigned int axis = 0; axis < dim; ++axis)
          slices = std::max(slices,
                            (at[body].upper[axis] - at[body].lower[axis]) * at[body].n_cells /
                              at[body].sum[axis]);
        const double unknowns = dim * n[body][0];
        result += unknowns * (unknowns / slices) * (unknowns / slices);
      }
    return result;
  }


  template double
  factorisation_work(const SolidModel<2> &);
  template double
  factorisation_work(const SolidModel<3> &);
} // namespace undine
