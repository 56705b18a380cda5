// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_solid_mesh_rest_geometry_h
#define undine_solid_mesh_rest_geometry_h

#include <deal.II/base/quadrature.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/mapping.h>

#include <vector>

namespace undine
{
  /// All that integrals over the rest configuration of the locally owned cells need, computed once.
  /// Local degrees of freedom are counted node by node: node * dim + axis.
  template <int dim>
  class RestGeometry
  {
  public:
    using CellIterator = typename dealii::DoFHandler<dim>::active_cell_iterator;

    /// Gauss quadrature with degree + 1 points per direction.
    RestGeometry(const dealii::Mapping<dim> &mapping, const dealii::DoFHandler<dim> &dof_handler);

    unsigned int
    n_cells() const; ///< locally owned

    /// Quadrature points of each cell.
    unsigned int
    n_points() const;

    /// Nodes of each cell.
    unsigned int
    n_nodes() const;

    const CellIterator &
    cell(unsigned int cell) const;

    /// Index of the body that the cell belongs to.
    unsigned int
    body(unsigned int cell) const;

    /// Global degrees of freedom, node by node.
    const std::vector<dealii::types::global_dof_index> &
    dofs(unsigned int cell) const;

    /// Quadrature weight times volume [m^dim].
    double
    JxW(unsigned int cell, unsigned int point) const;

    /// Rest position of a quadrature point [m].
    const dealii::Point<dim> &
    position(unsigned int cell, unsigned int point) const;

    /// Mean of the quadrature points [m] and mean width [m] of a cell. @{
    dealii::Point<dim>
    centre(unsigned int cell) const;
    double
    width(unsigned int cell) const;
    /// @}

    /// Value of a node's shape function [1].
    double
    shape(unsigned int node, unsigned int point) const;

    /// Gradients of all nodes' shape functions with respect to rest positions [1/m] at one point,
    /// into an array that may be reused from call to call.
    void
    gradients(std::vector<dealii::Tensor<1, dim>> &result,
              unsigned int                         cell,
              unsigned int                         point) const;

  private:
    /// Of one point of one cell.
    struct Point
    {
      dealii::Point<dim>     position;
      dealii::Tensor<2, dim> inverse_jacobian; ///< d(unit coordinate)_i / d(rest position)_j [1/m]
      double                 JxW;
    };

    struct Cell
    {
      CellIterator                                 iterator;
      std::vector<dealii::types::global_dof_index> dofs;
    };

    unsigned int                        points_per_cell;
    unsigned int                        nodes_per_cell;
    std::vector<Cell>                   cells;
    std::vector<Point>                  points;         ///< [cell * n_points + point]
    std::vector<double>                 shapes;         ///< [point * n_nodes + node]
    std::vector<dealii::Tensor<1, dim>> unit_gradients; ///< [point * n_nodes + node]
  };
} // namespace undine

#endif
