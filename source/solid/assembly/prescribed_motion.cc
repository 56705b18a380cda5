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


    /// The same of `what` is prescribed at `time` [s].
    template <int dim, class Value>
    void
    prescribe(Vector                &vector,
              const SolidModel<dim> &model,
              const std::string     &what,
              const double           time,
              const Value           &value)
    {
      std::string complaint;
      set_fixed(vector, model, [&](const FixedDof &fixed) {
        const double result = value(fixed);
        if (!std::isfinite(result) && complaint.empty())
          {
            const auto &body = model.bodies()[fixed.body];
            complaint = fmt::format("body '{}', boundary '{}': the prescribed {} at {:.6g} s is "
                                    "not a finite number. Try: another expression, or an "
                                    "earlier 'Time/End'.",
                                    body.name,
                                    body.boundaries[fixed.boundary].name,
                                    what,
                                    time);
          }
        return result;
      });
      throw_together<InputError>(complaint, model.communicator());
    }


    /// dg/dt of second order in the interval, within the step that ends at `time` [s]: motions may
    /// have a kink there, or no value beyond.
    template <class Function>
    double
    derivative(const Function &g, const double time, const double interval)
    {
      const double h = time < 2 * interval ? interval : -interval;
      return (-3 * g(time) + 4 * g(time + h) - g(time + 2 * h)) / (2 * h);
    }
  } // namespace


  template <int dim>
  void
  prescribe_displacement(Vector &displacement, const SolidModel<dim> &model, const double time)
  {
    prescribe(displacement, model, "displacement", time, [&](const FixedDof &fixed) {
      return model.prescribed_displacement(fixed, time);
    });
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
    prescribe(velocity, model, "velocity", time, [&](const FixedDof &fixed) {
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
    prescribe(acceleration, model, "acceleration", time, [&](const FixedDof &fixed) {
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
