// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/solid/mesh/solid_point.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>

namespace undine
{
  namespace
  {
    /// The cell of a body that holds a point, and where in it.
    template <int dim>
    struct Location
    {
      typename dealii::DoFHandler<dim>::active_cell_iterator cell;
      dealii::Point<dim>                                     unit_point;
      double distance = std::numeric_limits<double>::infinity(); ///< to the unit cell [1]
    };


    template <int dim>
    unsigned int
    find_body(const SolidModel<dim> &model, const std::string &name)
    {
      std::string names;
      for (unsigned int index = 0; index < model.bodies().size(); ++index)
        {
          if (model.bodies()[index].name == name)
            return index;
          names += (index == 0 ? "" : " | ") + model.bodies()[index].name;
        }
      throw InputError("there is no body '" + name + "'. Allowed: " + names);
    }


    /// The nearest cell; the first in the order of cells, which all ranks share, if several are.
    template <int dim>
    Location<dim>
    locate(const SolidModel<dim>    &model,
           const unsigned int        body,
           const dealii::Point<dim> &position)
    {
      Location<dim> best;
      for (const auto &cell : model.dof_handler().active_cell_iterators())
        if (cell->material_id() == body && cell->center().distance(position) <= cell->diameter())
          try
            {
              const auto   unit     = model.mapping().transform_real_to_unit_cell(cell, position);
              const double distance = dealii::GeometryInfo<dim>::distance_to_unit_cell(unit);
              if (distance < best.distance)
                best = {cell, dealii::GeometryInfo<dim>::project_to_unit_cell(unit), distance};
            }
          catch (const typename dealii::Mapping<dim>::ExcTransformationFailed &)
            {
            }
      return best;
    }
  } // namespace


  template <int dim>
  SolidPoint<dim>::SolidPoint(const SolidModel<dim>    &model,
                              const std::string        &body,
                              const dealii::Point<dim> &position)
    : communicator(model.communicator())
    , readable(model.ghosted(model.vector()))
  {
    const auto location = locate(model, find_body(model, body), position);
    if (!(location.distance < 1e-6))
      throw InputError(
        fmt::format("the point ({:g}) is not in the body '{}' at rest. Try: a point of its mesh, "
                    "whose curved sides are polygons",
                    fmt::join(position.begin_raw(), position.end_raw(), ", "),
                    body));
    owner = location.cell->subdomain_id();
    if (!location.cell->is_locally_owned())
      return;
    const auto &element = model.dof_handler().get_fe();
    dofs.resize(element.n_dofs_per_cell());
    location.cell->get_dof_indices(dofs);
    for (unsigned int i = 0; i < dofs.size(); ++i)
      {
        shapes.push_back(element.shape_value(i, location.unit_point));
        axes.push_back(element.system_to_component_index(i).first);
      }
  }


  template <int dim>
  dealii::Tensor<1, dim>
  SolidPoint<dim>::value(const dealii::TrilinosWrappers::MPI::Vector &field)
  {
    readable = field;
    dealii::Tensor<1, dim> result;
    for (unsigned int i = 0; i < dofs.size(); ++i)
      result[axes[i]] += shapes[i] * readable(dofs[i]);
    return dealii::Utilities::MPI::broadcast(communicator, result, owner);
  }


  template class SolidPoint<2>;
  template class SolidPoint<3>;
} // namespace undine
