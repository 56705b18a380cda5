// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_surface_facet_geometry_h
#define undine_surface_facet_geometry_h

#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <array>

namespace undine
{
  /// Corners of a segment in the plane or a triangle in space.
  template <int dim>
  using FacetNodes = std::array<dealii::Point<dim>, dim>;

  /// A facet with a thickness of the size of rounding, and as much wider, for intersection with
  /// segments. Facets without area are never met: their neighbours cover them.
  template <int dim>
  class ThickFacet
  {
  public:
    /// `thickness` [m] to either side.
    ThickFacet(const FacetNodes<dim> &nodes, const double thickness);

    /// The share of the segment from `from` to `to` at which it first comes within `thickness` of
    /// the facet's plane and its rims [1]; infinity if it does not.
    double
    first_hit(const dealii::Point<dim> &from, const dealii::Point<dim> &to) const;

  private:
    /// A ridge of a facet, and the direction in the facet's plane that points out across it.
    struct Rim
    {
      dealii::Point<dim>     place;
      dealii::Tensor<1, dim> outward; ///< unit
    };

    void
    set_rims(const FacetNodes<dim> &nodes);

    double                 thickness;
    dealii::Point<dim>     lower, upper; ///< corners of the box around it
    bool                   has_area;
    dealii::Point<dim>     in_plane;
    dealii::Tensor<1, dim> normal; ///< unit
    std::array<Rim, dim>   rims;
  };

  /// The point of a facet that is nearest to a place, by its barycentric coordinates. @{
  std::array<double, 2>
  nearest_point(const FacetNodes<2> &facet, const dealii::Point<2> &place);
  std::array<double, 3>
  nearest_point(const FacetNodes<3> &facet, const dealii::Point<3> &place);
  /// @}

  /// Whether a place lies in one of the simplices that a facet sweeps while its nodes move straight
  /// from `before` to `after`, or within `thickness` [m] of it. `order` of the nodes' numbers,
  /// lowest first: it makes the simplices of neighbouring facets fit each other.
  template <int dim>
  bool
  passes_over(const FacetNodes<dim>               &before,
              const FacetNodes<dim>               &after,
              const std::array<unsigned int, dim> &order,
              const dealii::Point<dim>            &place,
              const double                         thickness);
} // namespace undine

#endif
