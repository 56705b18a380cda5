// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/solid/mesh/rest_geometry.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe.h>
#include <deal.II/fe/fe_values.h>

#include <cmath>

namespace undine
{
  namespace
  {
    /// [node * dim + axis] -> index in the finite element's own order.
    template <int dim>
    std::vector<unsigned int>
    node_by_node(const dealii::FiniteElement<dim> &element)
    {
      std::vector<unsigned int> result(element.n_dofs_per_cell());
      for (unsigned int i = 0; i < result.size(); ++i)
        {
          const auto [axis, node]   = element.system_to_component_index(i);
          result[node * dim + axis] = i;
        }
      return result;
    }
  } // namespace


  template <int dim>
  RestGeometry<dim>::RestGeometry(const dealii::Mapping<dim>    &mapping,
                                  const dealii::DoFHandler<dim> &dof_handler)
  {
    const auto                                  &element = dof_handler.get_fe();
    const auto                                  &scalar  = element.base_element(0);
    const dealii::QGauss<dim>                    quadrature(element.degree + 1);
    const auto                                   order = node_by_node(element);
    dealii::FEValues<dim>                        values(mapping,
                                 scalar,
                                 quadrature,
                                 dealii::update_quadrature_points | dealii::update_JxW_values |
                                   dealii::update_inverse_jacobians);
    std::vector<dealii::types::global_dof_index> element_dofs(element.n_dofs_per_cell());

    points_per_cell = quadrature.size();
    nodes_per_cell  = scalar.n_dofs_per_cell();
    for (unsigned int q = 0; q < points_per_cell; ++q)
      for (unsigned int node = 0; node < nodes_per_cell; ++node)
        {
          shapes.push_back(scalar.shape_value(node, quadrature.point(q)));
          unit_gradients.push_back(scalar.shape_grad(node, quadrature.point(q)));
        }

    for (const auto &cell : dof_handler.active_cell_iterators())
      if (cell->is_locally_owned())
        {
          values.reinit(typename dealii::Triangulation<dim>::cell_iterator(cell));
          for (unsigned int q = 0; q < points_per_cell; ++q)
            points.push_back({values.quadrature_point(q),
                              dealii::Tensor<2, dim>(values.inverse_jacobian(q)),
                              values.JxW(q)});
          cell->get_dof_indices(element_dofs);
          cells.push_back({cell, {}});
          for (const unsigned int i : order)
            cells.back().dofs.push_back(element_dofs[i]);
        }
  }


  template <int dim>
  unsigned int
  RestGeometry<dim>::n_cells() const
  {
    return cells.size();
  }


  template <int dim>
  unsigned int
  RestGeometry<dim>::n_points() const
  {
    return points_per_cell;
  }


  template <int dim>
  unsigned int
  RestGeometry<dim>::n_nodes() const
  {
    return nodes_per_cell;
  }


  template <int dim>
  const typename RestGeometry<dim>::CellIterator &
  RestGeometry<dim>::cell(const unsigned int cell) const
  {
    return cells[cell].iterator;
  }


  template <int dim>
  unsigned int
  RestGeometry<dim>::body(const unsigned int cell) const
  {
    return cells[cell].iterator->material_id();
  }


  template <int dim>
  const std::vector<dealii::types::global_dof_index> &
  RestGeometry<dim>::dofs(const unsigned int cell) const
  {
    return cells[cell].dofs;
  }


  template <int dim>
  double
  RestGeometry<dim>::JxW(const unsigned int cell, const unsigned int point) const
  {
    return points[cell * points_per_cell + point].JxW;
  }


  template <int dim>
  const dealii::Point<dim> &
  RestGeometry<dim>::position(const unsigned int cell, const unsigned int point) const
  {
    return points[cell * points_per_cell + point].position;
  }


  template <int dim>
  dealii::Point<dim>
  RestGeometry<dim>::centre(const unsigned int cell) const
  {
    dealii::Point<dim> sum;
    for (unsigned int q = 0; q < points_per_cell; ++q)
      sum += position(cell, q);
    return sum / points_per_cell;
  }


  template <int dim>
  double
  RestGeometry<dim>::width(const unsigned int cell) const
  {
    double volume = 0;
    for (unsigned int q = 0; q < points_per_cell; ++q)
      volume += JxW(cell, q);
    return std::pow(volume, 1. / dim);
  }


  template <int dim>
  double
  RestGeometry<dim>::shape(const unsigned int node, const unsigned int point) const
  {
    return shapes[point * nodes_per_cell + node];
  }


  template <int dim>
  void
  RestGeometry<dim>::gradients(std::vector<dealii::Tensor<1, dim>> &result,
                               const unsigned int                   cell,
                               const unsigned int                   point) const
  {
    const auto &inverse = points[cell * points_per_cell + point].inverse_jacobian;
    const auto *unit    = &unit_gradients[point * nodes_per_cell];
    result.resize(nodes_per_cell);
    for (unsigned int node = 0; node < nodes_per_cell; ++node)
      result[node] = unit[node] * inverse;
  }


  template class RestGeometry<2>;
  template class RestGeometry<3>;
} // namespace undine
