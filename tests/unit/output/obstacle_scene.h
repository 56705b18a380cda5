// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_tests_output_obstacle_scene_h
#define undine_tests_output_obstacle_scene_h

#include <undine/coupled/immersed/fluid_geometry.h>

#include "sample_scene.h"

namespace undine_tests
{
  /// A wall thinner than a cell, across the middle of a box of fluid from one side to the other.
  template <int dim>
  struct ObstacleScene
  {
    explicit ObstacleScene(const MPI_Comm communicator)
    {
      const auto options = options_of(text());
      models.fluid       = std::make_unique<const FluidModel<dim>>(options, communicator);
      models.surface =
        std::make_unique<const ImmersedSurface<dim>>(options, nullptr, models.fluid->grid());
    }

    static std::string
    text()
    {
      return "subsection Domain\n set Lower corner = " + repeated<dim>("0") +
             "\n set Upper corner = " + repeated<dim>("1") +
             "\n set Cells = " + repeated<dim>("8") +
             "\nend\nsubsection Fluid\n set Density = 1000\nend\n"
             "subsection Obstacles\n subsection wall\n  set Shape = box\n  set Lower corner = "
             "0.45" +
             (", " + repeated<dim - 1>("-0.1")) + "\n  set Upper corner = 0.47" +
             (", " + repeated<dim - 1>("1.1")) + "\n  set Cells = " + repeated<dim>("1") +
             "\n  set Displacement = t" + std::string(dim == 2 ? "; 0" : "; 0; 0") +
             "\n end\nend\n";
    }

    /// Fields zero, as cut by the wall at `time`.
    State<dim>
    zero_state(const double time) const
    {
      State<dim> state;
      state.clock.time        = time;
      state.clock.end_time    = 1;
      state.surface_positions = models.surface->positions(state.solid, time);
      const auto open         = geometry_of(models, state)->cut_topology().open;
      state.fluid             = models.fluid->initial_state(open);
      state.fluid.scalars.emplace("smoke", Field<dim>(models.fluid->grid().cells(), open));
      return state;
    }

    /// Different numbers left and right of the wall, and for every field.
    State<dim>
    filled_state(const double time) const
    {
      auto   state  = zero_state(time);
      double factor = 1;
      for_each_field(state.fluid, [&](Field<dim> &field) {
        for_each(field.owned(), [&](const auto &index) {
          field(index) = number(field.lattice().point(index), time, factor);
        });
        for (std::size_t k = 0; k < field.parts().size(); ++k)
          field.parts()[k] = number(field.divided()->all()[k].place, time, factor);
        field.exchange();
        ++factor;
      });
      return state;
    }

    static double
    number(const dealii::Point<dim> &place, const double time, const double factor)
    {
      return (place[0] < 0.46 + time ? -3 : 7) + factor * linear_scalar(place) / 13;
    }

    /// The largest difference between two states, parts included; infinity if those differ.
    static double
    difference(const State<dim> &one, const State<dim> &two)
    {
      std::vector<const Field<dim> *> fields;
      double result = one.surface_positions == two.surface_positions ? 0 : 1e300;
      for_each_field(one.fluid, [&](const Field<dim> &field) { fields.push_back(&field); });
      auto other = fields.begin();
      for_each_field(two.fluid, [&](const Field<dim> &field) {
        for_each(field.owned(), [&](const auto &index) {
          result = std::max(result, std::abs(field(index) - (**other)(index)));
        });
        if (field.parts().size() != (*other)->parts().size())
          result = 1e300;
        else
          for (std::size_t k = 0; k < field.parts().size(); ++k)
            result = std::max(result, std::abs(field.parts()[k] - (*other)->parts()[k]));
        ++other;
      });
      return dealii::Utilities::MPI::max(result, MPI_COMM_WORLD);
    }

    Models<dim> models;

  private:
    template <class Fluid, class Action>
    static void
    for_each_field(Fluid &fluid, const Action &action)
    {
      for (unsigned int axis = 0; axis < dim; ++axis)
        {
          action(fluid.velocity[axis]);
          action(fluid.acceleration[axis]);
        }
      action(fluid.pressure);
      for (auto &scalar : fluid.scalars)
        action(scalar.second);
    }
  };
} // namespace undine_tests

#endif
