// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_surface_united_surface_h
#define undine_surface_united_surface_h

#include <undine/surface/held_pairs.h>
#include <undine/surface/surface.h>

#include <optional>
#include <vector>

namespace undine
{
  /// A facet of a united surface: a part of one of the surface it was made of.
  template <int dim>
  struct FacetPart
  {
    unsigned int                             facet;   ///< of which it is a part
    std::array<std::array<double, dim>, dim> corners; ///< in barycentric coordinates of that [1]

    /// Is it all of it, with the corners in the same order?
    bool
    is_whole() const
    {
      for (unsigned int k = 0; k < dim; ++k)
        if (corners[k][k] != 1)
          return false;
      return true;
    }
  };


  /// The surface of a union of bodies.
  template <int dim>
  struct UnitedSurface
  {
    Surface<dim>                    surface;   ///< the same nodes, and new ones where bodies cross
    std::vector<dealii::Point<dim>> positions; ///< of these nodes [m]
    std::vector<FacetPart<dim>>     parts;     ///< of each facet
  };

  /// The surface in which the bodies of each pair, which may overlap, are one: their facets end
  /// where they cross, and what lies in the other one is left out. Where nodes or edges of one body
  /// lie in facets of the other, they cross as if places differed from the given ones by 1e-8 to
  /// 1e-5 of the facets' size. Nothing if no facets cross, or if that leaves the result open all
  /// the same.
  template <int dim>
  std::optional<UnitedSurface<dim>>
  united_surface(const Surface<dim>                    &surface,
                 const std::vector<dealii::Point<dim>> &positions,
                 const std::vector<PairOfSurfaces>     &pairs);
} // namespace undine

#endif
