// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_fluid_visibility_obstruction_h
#define undine_fluid_visibility_obstruction_h

#include <undine/fluid/grid/lattice.h>

#include <deal.II/base/bounding_box.h>
#include <deal.II/base/point.h>
#include <deal.II/base/tensor.h>

#include <algorithm>
#include <functional>
#include <vector>

namespace undine
{
  /// The surfaces of bodies as the fluid meets them during one step: where they are at the end of
  /// their last motion, and which places that motion has freshly cleared.
  template <int dim>
  class Obstruction
  {
  public:
    virtual ~Obstruction() = default;

    /// The share of the segment from `from` to `to` at which a surface is met first [1]; infinity
    /// if none is. Segments that touch a surface, or begin or end on it, meet it.
    virtual double
    first_hit(const dealii::Point<dim> &from, const dealii::Point<dim> &to) const = 0;

    /// A facet, or its image beyond periodic sides.
    struct FacetImage
    {
      unsigned int           facet;
      dealii::Tensor<1, dim> to_facet; ///< shift from the image to the facet
    };

    /// The facets, and images of facets, that may have a part in `box`.
    virtual std::vector<FacetImage>
    facets_near(const dealii::BoundingBox<dim> &box) const = 0;

    /// The space between two parallel planes.
    struct Slab
    {
      dealii::Tensor<1, dim> normal; ///< unit
      double                 lower;  ///< of normal * x [m]
      double                 upper;

      /// Above, below or, 0, inside.
      int
      side(const dealii::Point<dim> &place) const
      {
        const double height = normal * place;
        return height > upper ? 1 : height < lower ? -1 : 0;
      }

      /// Are two places on the same side of it?
      bool
      leaves_open(const dealii::Point<dim> &a, const dealii::Point<dim> &b) const
      {
        const int side_of_a = side(a);
        return side_of_a != 0 && side_of_a == side(b);
      }
    };

    /// Facets together.
    struct Patch
    {
      Slab               slab;         ///< holds them, as thin as one of them suggests
      dealii::Point<dim> lower, upper; ///< corners of a box that holds them
      dealii::Point<dim> middle;
      double             radius; ///< of a ball around the middle that holds them [m]

      /// A slab wide enough to hold them too.
      Slab
      widened(const Slab &other) const
      {
        // n x = +-o x + (n -+ o) m + (n -+ o) (x - m), with o the normal here and m the middle
        const double sign    = slab.normal * other.normal < 0 ? -1 : 1;
        const auto   turn    = other.normal - sign * slab.normal;
        const double shift   = turn * middle;
        const double turned  = turn.norm() * radius;
        const double lowest  = sign > 0 ? slab.lower : -slab.upper;
        const double highest = sign > 0 ? slab.upper : -slab.lower;
        return {other.normal,
                std::min(other.lower, lowest + shift - turned),
                std::max(other.upper, highest + shift + turned)};
      }
    };

    /// The patch that these facets form.
    virtual Patch
    patch(const std::vector<FacetImage> &images) const = 0;

    /// Do these facets, all that have a part in `box`, form a wall there: all at less than 45
    /// degrees to the slab around them, and none with a rim in the box? Then, within the box,
    /// nothing on one side of the slab is visible from the other.
    virtual bool
    is_wall(const std::vector<FacetImage>  &images,
            const Slab                     &slab,
            const dealii::BoundingBox<dim> &box) const = 0;

    /// first_hit() of this facet alone.
    virtual double
    first_hit(const FacetImage         &image,
              const dealii::Point<dim> &from,
              const dealii::Point<dim> &to) const = 0;

    /// True if `place` is freshly cleared, which means that a surface has swept it in the last
    /// motion: values from before say nothing about the fluid that is there now.
    virtual bool
    is_freshly_cleared(const dealii::Point<dim> &place) const = 0;

    /// Where the last motion has taken what was at `place`: along with the surface that has swept
    /// it, to the same side of it, or nowhere.
    virtual dealii::Point<dim>
    carried(const dealii::Point<dim> &place) const = 0;

    /// Call `action` for all points of a lattice, boundary points and images included, that are in
    /// `box` and freshly cleared; for some more than once.
    virtual void
    for_each_freshly_cleared(const Lattice<dim>                                &lattice,
                             const IndexBox<dim>                               &box,
                             const std::function<void(const GridIndex<dim> &)> &action) const = 0;

    /// The point of the surfaces that is nearest to some place.
    struct NearestPoint
    {
      dealii::Tensor<1, dim> velocity;        ///< [m/s]
      bool                   is_free = false; ///< its motion follows from forces
    };

    virtual NearestPoint
    nearest_point_to(const dealii::Point<dim> &place) const = 0;

    /// Of the surface point nearest to `place` [m/s].
    dealii::Tensor<1, dim>
    nearest_velocity(const dealii::Point<dim> &place) const
    {
      return nearest_point_to(place).velocity;
    }
  };
} // namespace undine

#endif
