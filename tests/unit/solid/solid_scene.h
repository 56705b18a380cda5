// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_tests_solid_scene_h
#define undine_tests_solid_scene_h

#include <undine/solid/mesh/solid_model.h>
#include <undine/solid/mesh/solid_point.h>
#include <undine/solid/step/solid_columns.h>
#include <undine/solid/step/solid_stepper.h>

#include <fmt/format.h>
#include <scene_text.h>

#include <array>
#include <string>

namespace undine_tests
{
  using namespace undine;
  using Vector = dealii::TrilinosWrappers::MPI::Vector;
  using Matrix = dealii::TrilinosWrappers::SparseMatrix;

  /// A scene with one body 'body', whose section holds `body`, and boundaries `boundaries`; the
  /// others are sections 'Solid numerics' and 'Time'.
  inline std::string
  one_body(const std::string &body,
           const std::string &boundaries = "",
           const std::string &numerics   = "",
           const std::string &time       = "")
  {
    return "subsection Bodies\n subsection body\n" + body + "\n subsection Boundaries\n" +
           boundaries + "\n end\n end\nend\nsubsection Solid numerics\n" + numerics +
           "\nend\nsubsection Time\n" + time + "\nend\n";
  }


  /// The first text in 2D, the second in 3D.
  template <int dim>
  std::string
  plane_or_space(const std::string &plane, const std::string &space)
  {
    return std::array<std::string, 2>{{plane, space}}[dim - 2];
  }


  inline std::string
  boundary(const std::string &name, const std::string &keys)
  {
    return "subsection " + name + "\n" + keys + "\nend\n";
  }


  /// A model with its step and its state at t = 0.
  template <int dim>
  struct Solid
  {
    explicit Solid(const std::string           &text,
                   const SolidEnvironment<dim> &environment = SolidEnvironment<dim>(),
                   const double                 first_step  = 0.01)
      : model(read_scene_text(text), MPI_COMM_WORLD)
      , stepper(model)
      , environment(environment)
      , state(stepper.initialize(environment, 0, first_step))
    {
    }

    SolidReport<dim>
    advance(const double dt)
    {
      report = stepper.step(state, environment, time, dt, timing);
      time += dt;
      return report;
    }

    Columns
    columns() const
    {
      return solid_columns(model, stepper, environment, state, time, report);
    }

    double
    column(const std::string &name) const
    {
      for (const auto &column : columns())
        if (column.name == name)
          return column.value;
      throw std::runtime_error("no column " + name);
    }

    dealii::Tensor<1, dim>
    displacement(const dealii::Point<dim> &position) const
    {
      return SolidPoint<dim>(model, "body", position).value(state.displacement);
    }

    dealii::Tensor<1, dim>
    velocity(const dealii::Point<dim> &position) const
    {
      return SolidPoint<dim>(model, "body", position).value(state.velocity);
    }

    SolidModel<dim>       model;
    SolidStepper<dim>     stepper;
    SolidEnvironment<dim> environment;
    SolidState            state;
    SolidReport<dim>      report;
    TimingTree            timing;
    double                time = 0;
  };
} // namespace undine_tests

#endif
