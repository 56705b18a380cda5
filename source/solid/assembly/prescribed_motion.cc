// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/parallel/throw_together.h>
#include <undine/solid/assembly/prescribed_motion.h>

#include <fmt/format.h>

#include <cmath>

namespace undine
{
  using Vector = dealii::TrilinosWrappers::MPI::Vector;

  namespace
  {
    /// vector[fixed] = value(fixed) for all fixed degrees of freedom of this rank.
    template <int dim, class Value>
    void
    set_fixed(Vector &vector, const SolidModel<dim> &model, const Value &value)
    {
      for (const auto &fixed : model.fixed())
        vector(fixed.dof) = value(fixed);
      vector.compress(dealii::VectorOperation::insert);
    }


    /// dg/dt of second order in the interval.
    template <class Function>
    double
    derivative(const Function &g, const double time, const double interval)
    {
      if (time < interval)
        return (-3 * g(time) + 4 * g(time + interval) - g(time + 2 * interval)) / (2 * interval);
      return (g(time + interval) - g(time - interval)) / (2 * interval);
    }
  } // namespace


  template <int dim>
  void
  prescribe_displacement(Vector &displacement, const SolidModel<dim> &model, const double time)
  {
    std::string complaint;
    set_fixed(displacement, model, [&](const FixedDof &fixed) {
      const double value = model.prescribed_displacement(fixed, time);
      if (!std::isfinite(value) && complaint.empty())
        {
          const auto &body = model.bodies()[fixed.body];
          complaint        = fmt::format("body '{}', boundary '{}': the prescribed displacement at "
                                         "{:.6g} s is not a finite number. Try: another expression, "
                                         "or an earlier 'Time/End'.",
                                  body.name,
                                  body.boundaries[fixed.boundary].name,
                                  time);
        }
      return value;
    });
    throw_together<InputError>(complaint, model.communicator());
  }


  template <int dim>
  void
  prescribe_velocity(Vector                &velocity,
                     const SolidModel<dim> &model,
                     const double           time,
                     const double           dt)
  {
    // Short enough for the difference to be exact beside the step's own error, long enough for
    // rounding not to be felt.
    const double interval = 1e-3 * dt;
    set_fixed(velocity, model, [&](const FixedDof &fixed) {
      return derivative(
        [&](const double t) { return model.prescribed_displacement(fixed, t); }, time, interval);
    });
  }


  template <int dim>
  void
  prescribe_acceleration(Vector                &acceleration,
                         const SolidModel<dim> &model,
                         const double           time,
                         const double           dt)
  {
    const double interval = 0.02 * dt;
    set_fixed(acceleration, model, [&](const FixedDof &fixed) {
      const auto g        = [&](const double t) { return model.prescribed_displacement(fixed, t); };
      const auto velocity = [&](const double t) { return derivative(g, t, interval); };
      return derivative(velocity, time, interval);
    });
  }


  template <int dim>
  void
  clear_fixed(Vector &vector, const SolidModel<dim> &model)
  {
    set_fixed(vector, model, [](const FixedDof &) { return 0.; });
  }


#define UNDINE_INSTANTIATE(dim)                                                            \
  template void prescribe_displacement(Vector &, const SolidModel<dim> &, double);         \
  template void prescribe_velocity(Vector &, const SolidModel<dim> &, double, double);     \
  template void prescribe_acceleration(Vector &, const SolidModel<dim> &, double, double); \
  template void clear_fixed(Vector &, const SolidModel<dim> &);

  UNDINE_INSTANTIATE(2)
  UNDINE_INSTANTIATE(3)
#undef UNDINE_INSTANTIATE
} // namespace undine
