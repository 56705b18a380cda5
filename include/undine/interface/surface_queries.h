// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_interface_surface_queries_h
#define undine_interface_surface_queries_h

#include <undine/fluid/mac_grid.h>
#include <undine/fluid/obstruction.h>
#include <undine/interface/surface.h>

#include <array>
#include <memory>
#include <vector>

namespace undine
{
  /// A surface and its motion during the last step.
  template <int dim>
  struct MovedSurface
  {
    const Surface<dim>                 *surface;
    std::vector<dealii::Point<dim>>     old_positions; ///< of the nodes, before the step [m]
    std::vector<dealii::Point<dim>>     positions;     ///< after it [m]
    std::vector<dealii::Tensor<1, dim>> velocities;    ///< [m/s]
  };

  /// Answers where a surface lies, in a time that grows with the logarithm of its facets (R-tree of
  /// their boxes).
  ///
  /// Facets are taken as thick as rounding: `tolerance` times the size of the domain, and as much
  /// wider. No way slips through between facets that share an edge or a node.
  ///
  /// In periodic directions the surface repeats.
  template <int dim>
  class SurfaceQueries : public Obstruction<dim>
  {
  public:
    static constexpr double tolerance = 1e-13;

    /// Keeps the positions, not the surface's copy: that must outlive it.
    SurfaceQueries(const MacGrid<dim> &grid, MovedSurface<dim> moved);

    ~SurfaceQueries();

    double
    first_hit(const dealii::Point<dim> &from, const dealii::Point<dim> &to) const override;

    bool
    swept(const dealii::Point<dim> &place) const override;

    dealii::Tensor<1, dim>
    nearest_velocity(const dealii::Point<dim> &place) const override;

  private:
    struct Trees;

    std::array<dealii::Point<dim>, dim>
    nodes(const unsigned int facet) const;

    std::array<dealii::Point<dim>, dim>
    old_nodes(const unsigned int facet) const;

    MovedSurface<dim>            moved;
    std::array<double, dim>      periods; ///< [m]; 0: not periodic
    double                       thickness;
    std::unique_ptr<const Trees> trees;
  };
} // namespace undine

#endif
