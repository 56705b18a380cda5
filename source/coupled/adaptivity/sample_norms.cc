// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/core/divided_differences.h>
#include <undine/coupled/adaptivity/sample_norms.h>
#include <undine/solid/assembly/mass_matrix.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace undine
{
  namespace
  {
    using dealii::Utilities::MPI::max;
    using dealii::Utilities::MPI::min;
    using dealii::Utilities::MPI::sum;


    template <int dim>
    bool
    is_whole(const Field<dim> &field, const GridIndex<dim> &index)
    {
      const auto *divided = field.divided();
      return !divided || divided->kind(index) == SubLattice<dim>::Kind::whole;
    }
  } // namespace


  template <int dim>
  SampleNorms<dim>::SampleNorms(const Models<dim> &models)
    : models(models)
  {
    if (!models.solid)
      return;
    mass.copy_from(mass_matrix(*models.solid));
    auto ones = models.solid->vector(), product = ones;
    ones = 1.;
    mass.vmult(product, ones);
    total_mass = (ones * product) / dim;
  }


  template <int dim>
  double
  SampleNorms<dim>::of_bodies(const Vector &vector) const
  {
    Vector product = models.solid->vector();
    mass.vmult(product, vector);
    return std::sqrt(std::max(0., product * vector) / total_mass);
  }


  template <int dim>
  double
  SampleNorms<dim>::bodies_derivative(const std::vector<const Sample *> &samples) const
  {
    std::vector<double> times;
    times.reserve(samples.size());
    for (const auto *sample : samples)
      times.push_back(sample->time);
    const auto weights    = derivative_weights(times);
    Vector     derivative = models.solid->vector();
    for (std::size_t i = 0; i < samples.size(); ++i)
      derivative.add(weights[i], samples[i]->bodies);
    return of_bodies(derivative);
  }


  template <int dim>
  double
  SampleNorms<dim>::fluid_derivative(const StepHistory<dim> &history,
                                     const unsigned int      order) const
  {
    std::vector<double> times;
    for (unsigned int i = 0; i <= order; ++i)
      times.push_back(history.samples[i].time);
    const auto  weights = derivative_weights(times);
    const auto &grid    = models.fluid->grid();
    double      squares = 0, volume = 0;
    for (unsigned int axis = 0; axis < dim; ++axis)
      for_each(history.uncut[axis].owned(), [&](const GridIndex<dim> &face) {
        if (history.uncut[axis](face) <= order)
          return;
        double derivative = 0;
        for (unsigned int i = 0; i <= order; ++i)
          derivative += weights[i] * history.samples[i].fluid[axis](face);
        squares += grid.dual_volume(axis, face) * derivative * derivative;
        volume += grid.dual_volume(axis, face) / dim;
      });
    squares = sum(squares, grid.communicator());
    volume  = sum(volume, grid.communicator());
    return volume > 0 ? std::sqrt(squares / volume) : 0;
  }


  /// `value(axis, face)` on faces that no body cuts in `velocity`, where it is wanted.
  template <int dim>
  template <class Value>
  double
  SampleNorms<dim>::root_mean_square(const Velocity<dim> &velocity, const Value &value) const
  {
    const auto &grid    = models.fluid->grid();
    double      squares = 0, volume = 0;
    for (unsigned int axis = 0; axis < dim; ++axis)
      for_each(velocity[axis].owned(), [&](const GridIndex<dim> &face) {
        const std::optional<double> here =
          is_whole(velocity[axis], face) ? value(axis, face) : std::nullopt;
        if (!here)
          return;
        squares += grid.dual_volume(axis, face) * *here * *here;
        volume += grid.dual_volume(axis, face) / dim;
      });
    squares = sum(squares, grid.communicator());
    volume  = sum(volume, grid.communicator());
    return volume > 0 ? std::sqrt(squares / volume) : 0;
  }


  template <int dim>
  double
  SampleNorms<dim>::of_fluid(const Velocity<dim> &velocity) const
  {
    return root_mean_square(velocity, [&](const unsigned int axis, const GridIndex<dim> &face) {
      return std::optional<double>(velocity[axis](face));
    });
  }


  template <int dim>
  double
  SampleNorms<dim>::of_change(const Velocity<dim> &before, const Velocity<dim> &after) const
  {
    return root_mean_square(after, [&](const unsigned int axis, const GridIndex<dim> &face) {
      return is_whole(before[axis], face)
               ? std::optional<double>(after[axis](face) - before[axis](face))
               : std::nullopt;
    });
  }


  template <int dim>
  double
  SampleNorms<dim>::extent_of_bodies() const
  {
    const auto &solid   = *models.solid;
    double      longest = 0;
    for (unsigned int axis = 0; axis < dim; ++axis)
      {
        double lower = std::numeric_limits<double>::max(), upper = -lower;
        for (const auto dof : solid.locally_owned())
          {
            lower = std::min(lower, solid.rest_position(dof)[axis]);
            upper = std::max(upper, solid.rest_position(dof)[axis]);
          }
        longest =
          std::max(longest, max(upper, solid.communicator()) - min(lower, solid.communicator()));
      }
    return longest;
  }


  template <int dim>
  Velocity<dim>
  SampleNorms<dim>::zero_velocity() const
  {
    Velocity<dim> result;
    for (unsigned int axis = 0; models.fluid && axis < dim; ++axis)
      result[axis] = Field<dim>(models.fluid->grid().faces(axis));
    return result;
  }


  template <int dim>
  typename SampleNorms<dim>::Sample
  SampleNorms<dim>::sample(const State<dim> &state, const double time) const
  {
    Sample result{time, state.solid.velocity, zero_velocity()};
    for (unsigned int axis = 0; models.fluid && axis < dim; ++axis)
      for_each(result.fluid[axis].owned(), [&](const GridIndex<dim> &face) {
        if (is_whole(state.fluid.velocity[axis], face))
          result.fluid[axis](face) = state.fluid.velocity[axis](face);
      });
    return result;
  }


  template <int dim>
  void
  SampleNorms<dim>::count_uncut(Velocity<dim> &uncut, const Velocity<dim> &velocity) const
  {
    for (unsigned int axis = 0; models.fluid && axis < dim; ++axis)
      for_each(uncut[axis].owned(), [&](const GridIndex<dim> &face) {
        uncut[axis](face) = is_whole(velocity[axis], face) ? uncut[axis](face) + 1 : 0.;
      });
  }


  template class SampleNorms<2>;
  template class SampleNorms<3>;
} // namespace undine
