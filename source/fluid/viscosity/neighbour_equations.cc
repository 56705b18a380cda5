// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/viscosity/diffusion_solver.h>
#include <undine/fluid/viscosity/neighbour_equations.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace undine
{
  namespace
  {
    // Relaxation in single precision gains no more than this at a time.
    constexpr double least_reduction = 1e-5;

    // With more sweeps at a time a hierarchy of grids is faster.
    constexpr unsigned int most_sweeps = 100;
  } // namespace


  template <int dim>
  NeighbourEquations<dim>::NeighbourEquations(std::shared_ptr<const Lattice<dim>> lattice)
    : points(std::move(lattice))
    , stored(points->with_ghosts(points->blocks().rank(), all_directions<dim>(1)))
  {
    const auto &mine   = points->owned();
    box.parity         = 0;
    std::ptrdiff_t all = 1;
    for (unsigned int d = 0; d < dim; ++d)
      {
        box.lengths[d] = mine.upper[d] - mine.lower[d];
        box.strides[d] = all;
        box.parity     = (box.parity + mine.lower[d]) % 2;
        all *= stored.upper[d] - stored.lower[d];
      }
    // Neighbours beyond the ends of the domain, whose entries are zero, are somewhere in the array.
    box.first = box.strides[dim - 1];
    box.first = position(mine.lower);
    size      = all + 2 * box.strides[dim - 1];
    for (auto *entries : {&above, &below})
      for (auto &along : *entries)
        along.assign(size, 0.);
    for (auto *entries : {&rough_above, &rough_below})
      for (auto &along : *entries)
        along.assign(size, 0.f);
    for (auto *array : {&diagonal, &right_side, &values, &residual})
      array->assign(size, 0.);
    for (auto *array : {&rough_inverse, &rough_residual, &correction})
      array->assign(size, 0.f);
  }


  template <int dim>
  std::ptrdiff_t
  NeighbourEquations<dim>::position(const GridIndex<dim> &index) const
  {
    std::ptrdiff_t result = box.strides[dim - 1];
    for (unsigned int d = 0; d < dim; ++d)
      result += (index[d] - stored.lower[d]) * box.strides[d];
    return result;
  }


  template <int dim>
  template <typename Number>
  StencilEntries<dim, Number>
  NeighbourEquations<dim>::entries(const std::array<std::vector<Number>, dim> &above,
                                   const std::array<std::vector<Number>, dim> &below) const
  {
    StencilEntries<dim, Number> result;
    for (unsigned int d = 0; d < dim; ++d)
      {
        result.above[d] = above[d].data();
        result.below[d] = below[d].data();
      }
    return result;
  }


  template <int dim>
  template <typename Number>
  void
  NeighbourEquations<dim>::exchange(std::vector<Number> &values) const
  {
    const auto one  = all_directions<dim>(1);
    const auto room = box.strides[dim - 1];
    points->ghost_layers(one, one).update(
      dealii::ArrayView<Number>(values.data() + room, size - 2 * room));
  }


  template <int dim>
  double
  NeighbourEquations<dim>::norm(const std::vector<double> &of) const
  {
    double sum = 0;
    box.for_each_row([&](const std::ptrdiff_t row, const int) {
      for (int i = 0; i < box.lengths[0]; ++i)
        sum += of[row + i] * of[row + i];
    });
    return std::sqrt(dealii::Utilities::MPI::sum(sum, points->blocks().communicator()));
  }


  template <int dim>
  double
  NeighbourEquations<dim>::find_residual()
  {
    exchange(values);
    const auto all = entries(above, below);
    box.for_each_row([&](const std::ptrdiff_t row, const int) {
      double *const result = residual.data() + row;
      subtract_neighbours(result, right_side.data(), values.data(), all, box, row);
      for (int i = 0; i < box.lengths[0]; ++i)
        result[i] -= diagonal[row + i] * values[row + i];
    });
    return norm(residual);
  }


  template <int dim>
  typename NeighbourEquations<dim>::Relaxation
  NeighbourEquations<dim>::prepare_relaxation()
  {
    double alpha = 0, beta = 0;
    bool   positive = true;
    box.for_each_row([&](const std::ptrdiff_t row, const int) {
      for (auto i = row; i < row + box.lengths[0]; ++i)
        {
          const double inverse = 1 / diagonal[i];
          double       real = 0, imaginary = 0;
          for (unsigned int d = 0; d < dim; ++d)
            {
              const double product = above[d][i] * below[d][i];
              real += std::sqrt(std::max(0., product));
              imaginary += std::sqrt(std::max(0., -product));
              rough_above[d][i] = static_cast<float>(above[d][i]);
              rough_below[d][i] = static_cast<float>(below[d][i]);
            }
          rough_inverse[i] = static_cast<float>(inverse);
          alpha            = std::max(alpha, 2 * real * inverse);
          beta             = std::max(beta, 2 * imaginary * inverse);
          positive         = positive && diagonal[i] > 0;
        }
    });
    const auto communicator = points->blocks().communicator();
    alpha                   = dealii::Utilities::MPI::max(alpha, communicator);
    beta                    = dealii::Utilities::MPI::max(beta, communicator);
    if (!dealii::Utilities::MPI::logical_or(!positive, communicator) && alpha < 1)
      {
        const double root = std::sqrt(1 - alpha * alpha + beta * beta);
        return {2 / (1 + root), std::pow((alpha + beta) / (1 + root), 2)};
      }
    return {1, 1};
  }


  /// How many sweeps reduce errors to `wanted` of what they were: two more than in the long run,
  /// since over-relaxation first lets some grow.
  template <int dim>
  unsigned int
  NeighbourEquations<dim>::Relaxation::sweeps(const double wanted) const
  {
    const double n = 2 + std::ceil(std::log(wanted) / std::log(reduction));
    return n <= most_sweeps ? static_cast<unsigned int>(n) : most_sweeps + 1;
  }


  /// Relax the equations for what the values, whose residual has the norm `size`, lack.
  template <int dim>
  void
  NeighbourEquations<dim>::correct(const Relaxation  &relaxation,
                                   const unsigned int n_sweeps,
                                   const double       size)
  {
    const double scale = 1 / size; // which single precision might not know
    box.for_each_row([&](const std::ptrdiff_t row, const int) {
      for (int i = 0; i < box.lengths[0]; ++i)
        rough_residual[row + i] = static_cast<float>(scale * residual[row + i]);
    });
    std::fill(correction.begin(), correction.end(), 0.f);
    const auto all = entries(rough_above, rough_below);
    for (unsigned int half = 0; half < 2 * n_sweeps; ++half)
      {
        if (half > 0)
          exchange(correction);
        relax(correction.data(),
              rough_residual.data(),
              rough_inverse.data(),
              all,
              box,
              half % 2,
              static_cast<float>(relaxation.omega));
      }
    box.for_each_row([&](const std::ptrdiff_t row, const int) {
      for (int i = 0; i < box.lengths[0]; ++i)
        values[row + i] += size * correction[row + i];
    });
  }


  template <int dim>
  std::optional<unsigned int>
  NeighbourEquations<dim>::solve(Field<dim> &field)
  {
    const auto relaxation = prepare_relaxation();
    if (!(relaxation.reduction < 1) || relaxation.sweeps(least_reduction) > most_sweeps)
      return {};
    for_each_row(points->owned(), [&](const GridIndex<dim> &first, const int n) {
      std::copy_n(field.data(first), n, values.begin() + position(first));
    });
    const double tolerance = DiffusionSolver::tolerance(norm(right_side));
    double       now       = find_residual();
    unsigned int result    = 0;
    while (now > tolerance)
      {
        const auto n_sweeps =
          relaxation.sweeps(std::clamp(tolerance / (2 * now), least_reduction, 0.1));
        correct(relaxation, n_sweeps, now);
        const double before = std::exchange(now, find_residual());
        result += n_sweeps;
        if (!(now < before / 2))
          return {};
      }
    for_each_row(points->owned(), [&](const GridIndex<dim> &first, const int n) {
      std::copy_n(values.begin() + position(first), n, field.data(first));
    });
    return result;
  }


  template <int dim>
  std::size_t
  NeighbourEquations<dim>::memory_consumption() const
  {
    constexpr std::size_t doubles = 2 * dim + 4, floats = 2 * dim + 3;
    return size * (doubles * sizeof(double) + floats * sizeof(float));
  }


  template class NeighbourEquations<2>;
  template class NeighbourEquations<3>;
} // namespace undine
