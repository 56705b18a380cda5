// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/output/probe.h>

#include <deal.II/base/geometry_info.h>

#include <algorithm>

namespace undine
{
  /// A material point of a body: displacement [m] and velocity [m/s].
  template <int dim>
  class BodyPoint : public Probe<dim>
  {
  public:
    void
    add_options(const Options &options) override
    {
      options.require(
        "Body", body, "", Allowed::anything(), "Name of the body that the point belongs to.");
      options.require(
        "Point", point, "m", Allowed::anything(), "Position of the material point at rest.");
    }

    void
    start(const std::string &probe_name, const Options &options, const Models<dim> &models) override
    {
      name              = probe_name;
      const auto number = find_body(options, models);
      find_cell(options, *models.solid, number);
    }

    Columns
    columns(const Models<dim> &models, const State<dim> &state) const override
    {
      const auto &solid        = *models.solid;
      const auto  displacement = value(solid, state.solid.displacement);
      const auto  velocity     = value(solid, state.solid.velocity);
      Columns     result;
      for (unsigned int axis = 0; axis < dim; ++axis)
        result.push_back({name + ": displacement " + char('x' + axis), "m", displacement[axis]});
      for (unsigned int axis = 0; axis < dim; ++axis)
        result.push_back({name + ": velocity " + char('x' + axis), "m/s", velocity[axis]});
      return result;
    }

  private:
    using Cell  = typename dealii::DoFHandler<dim>::active_cell_iterator;
    using Index = dealii::types::global_dof_index;

    /// One node that the value at the point depends on.
    struct Share
    {
      Index        dof;
      unsigned int axis;
      double       weight; ///< of the node's shape function [1]
    };

    unsigned int
    find_body(const Options &options, const Models<dim> &models) const
    {
      std::string names;
      if (models.solid)
        for (unsigned int b = 0; b < models.solid->bodies().size(); ++b)
          {
            if (models.solid->bodies()[b].name == body)
              return b;
            names += (b == 0 ? "" : " | ") + models.solid->bodies()[b].name;
          }
      throw options.error("Body",
                          "there is no body '" + body + "'",
                          names.empty() ? "The scene has no bodies." : "Allowed: " + names);
    }

    /// All ranks know all cells, search all, and find the same.
    void
    find_cell(const Options &options, const SolidModel<dim> &solid, const unsigned int number)
    {
      constexpr double   rounding         = 1e-6; // of a cell
      double             nearest_distance = rounding;
      Cell               nearest;
      dealii::Point<dim> nearest_unit;
      for (const auto &cell : solid.dof_handler().active_cell_iterators())
        if (cell->material_id() == number)
          {
            auto box = cell->bounding_box();
            box.extend(rounding * cell->diameter());
            dealii::Point<dim> unit;
            if (!box.point_inside(point) || !locate(solid, cell, unit))
              continue;
            const double distance = dealii::GeometryInfo<dim>::distance_to_unit_cell(unit);
            if (distance < nearest_distance)
              {
                nearest_distance = distance;
                nearest          = cell;
                nearest_unit     = unit;
              }
          }
      if (nearest_distance == rounding)
        throw options.error("Point",
                            "the point (" + write_value(point) + ") is not in the body '" + body +
                              "' at rest",
                            "Try: a point inside it or on its boundary.");
      collect(nearest, nearest_unit);
    }

    bool
    locate(const SolidModel<dim> &solid, const Cell &cell, dealii::Point<dim> &unit) const
    {
      try
        {
          unit = solid.mapping().transform_real_to_unit_cell(cell, point);
          return true;
        }
      catch (const typename dealii::Mapping<dim>::ExcTransformationFailed &)
        {
          return false;
        }
    }

    void
    collect(const Cell &cell, const dealii::Point<dim> &unit)
    {
      const auto        &element = cell->get_fe();
      std::vector<Index> dofs(element.n_dofs_per_cell());
      cell->get_dof_indices(dofs);
      const auto unit_inside = dealii::GeometryInfo<dim>::project_to_unit_cell(unit);
      shares.clear();
      for (unsigned int i = 0; i < dofs.size(); ++i)
        shares.push_back({dofs[i],
                          element.system_to_component_index(i).first,
                          element.shape_value(i, unit_inside)});
    }

    /// Every rank adds the nodes that it owns.
    dealii::Tensor<1, dim>
    value(const SolidModel<dim> &solid, const dealii::TrilinosWrappers::MPI::Vector &vector) const
    {
      dealii::Tensor<1, dim> mine;
      for (const auto &share : shares)
        if (solid.locally_owned().is_element(share.dof))
          mine[share.axis] += share.weight * vector(share.dof);
      return dealii::Utilities::MPI::sum(mine, solid.communicator());
    }

    std::string        name;
    std::string        body;
    dealii::Point<dim> point;
    std::vector<Share> shares;
  };


  namespace
  {
    const RegisterForDimensions<Probe, BodyPoint>
      body_point("body point", "displacement and velocity of a material point of a body");
  }
} // namespace undine
