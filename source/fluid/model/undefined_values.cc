// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/options/values.h>
#include <undine/base/parallel/throw_together.h>
#include <undine/fluid/boundary/side_faces.h>
#include <undine/fluid/model/undefined_values.h>

#include <fmt/format.h>

#include <cmath>

namespace undine
{
  namespace
  {
    template <int dim>
    std::string
    complaint(const std::string        &section,
              const std::string        &key,
              const dealii::Point<dim> &place,
              const double              time)
    {
      return fmt::format(
        "section '{}', key '{}': is not a finite number at ({}) and {:.6g} s. "
        "Try: an expression that has a value in the whole domain until 'Time/End'.",
        section,
        key,
        write_value(place),
        time);
    }


    /// Of one face.
    template <int dim>
    std::string
    undefined_in_face(const Boundary<dim>      &boundary,
                      const unsigned int        axis,
                      const dealii::Point<dim> &place,
                      const double              time)
    {
      const std::string section = "Fluid/Boundaries/" + boundary.name;
      if (!std::isfinite(boundary.velocity_along(axis, axis, place, time)))
        return complaint(section, "Velocity", place, time);
      if (boundary.is_open() && !std::isfinite(boundary.pressure.value(place, time)))
        return complaint(section, "Pressure", place, time);
      return "";
    }
  } // namespace


  template <int dim>
  std::string
  undefined_initial_velocity(const FluidModel<dim>                           &model,
                             const std::shared_ptr<const FluidTopology<dim>> &topology)
  {
    const auto  initial = model.initial_state(topology);
    std::string first;
    for (unsigned int axis = 0; axis < dim; ++axis)
      for_each_value(initial.velocity[axis],
                     [&](const double value, const auto &place, const auto &) {
                       if (!std::isfinite(value) && first.empty())
                         first = complaint("Fluid", "Initial velocity", place, 0);
                     });
    return first_message(first, model.grid().communicator());
  }


  template <int dim>
  std::string
  undefined_boundary_value(const FluidModel<dim>                           &model,
                           const std::shared_ptr<const FluidTopology<dim>> &topology,
                           const double                                     time)
  {
    std::string first;
    for_each_side_face(
      model.grid(), topology.get(), [&](const SideFace<dim> &face, const auto &place) {
        if (first.empty())
          first = undefined_in_face(
            model.boundaries().at(face.side, face.cell), face.side.axis, place, time);
      });
    return first_message(first, model.grid().communicator());
  }


  template std::string
  undefined_initial_velocity(const FluidModel<2> &,
                             const std::shared_ptr<const FluidTopology<2>> &);
  template std::string
  undefined_boundary_value(const FluidModel<2> &,
                           const std::shared_ptr<const FluidTopology<2>> &,
                           const double);
  template std::string
  undefined_initial_velocity(const FluidModel<3> &,
                             const std::shared_ptr<const FluidTopology<3>> &);
  template std::string
  undefined_boundary_value(const FluidModel<3> &,
                           const std::shared_ptr<const FluidTopology<3>> &,
                           const double);
} // namespace undine
