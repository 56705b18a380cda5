// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_cutting_sampled_regions_h
#define undine_cutting_sampled_regions_h

#include <undine/cutting/cut_workspace.h>

#include <deal.II/base/point.h>

#include <array>
#include <vector>

namespace undine
{
  /// The fluid in a box found by sampling n_along^dim points: for cells in which bodies overlap or
  /// are inside out. Volumes are as good as the samples, connections as wide as their distance, and
  /// none goes through a facet, however thin the body is.
  /// Each sample has a bin of its own, whose facets alone tell how windings change in it.
  template <int dim>
  class SampledRegions
  {
  public:
    static constexpr int n_along = 8;

    using Simplex = std::array<dealii::Point<dim>, dim>;

    /// A connected part of the fluid.
    struct Region
    {
      double             volume = 0; ///< [m^dim]
      dealii::Point<dim> centroid;   ///< [m]
    };

    /// Winding numbers in the corners of a box, bit d of the position set for the upper end of axis
    /// d.
    using CornerWindings = std::array<int, (1 << dim)>;

    /// The box [lower, lower + widths]; `simplices` are the facets in it, normals out of the solid.
    /// Corners lie infinitesimally below their places at upper ends, at lower ones below or above
    /// as `lower_shifts` = -1 or 1 says.
    SampledRegions(const dealii::Point<dim>     &lower,
                   const dealii::Tensor<1, dim> &widths,
                   const CornerWindings         &corner_windings,
                   const dealii::Tensor<1, dim> &lower_shifts,
                   const std::vector<Simplex>   &simplices);

    const std::vector<Region> &
    regions() const
    {
      return all_regions;
    }

    /// Whether there is fluid just outside a place on a facet with this unit normal, not the inside
    /// of another body.
    bool
    is_wet(const dealii::Point<dim> &place, const dealii::Tensor<1, dim> &normal) const;

    /// The region of the sample in the fluid nearest to `place` of those that no facet hides, if
    /// there are any; -1 if there is no fluid.
    int
    nearest(const dealii::Point<dim> &place) const;

  private:
    struct Facet
    {
      Simplex                nodes;
      dealii::Tensor<1, dim> normal; ///< as long as its area
      IndexBox<dim>          bins;   ///< that it may touch
    };

    dealii::Point<dim>
    sample(const GridIndex<dim> &index) const;

    GridIndex<dim>
    bin(const dealii::Point<dim> &place) const;

    void
    add_facets(const std::vector<Simplex> &simplices);

    static int
    crossing(const Facet &facet, const dealii::Point<dim> &from, const dealii::Point<dim> &to);

    /// How often the segment between two places enters the solid through facets that may touch bin
    /// `here`, but not bin `counted`, minus how often it leaves it.
    int
    crossings(const dealii::Point<dim> &from,
              const dealii::Point<dim> &to,
              const GridIndex<dim>     &here,
              const GridIndex<dim>     &counted) const;

    /// Of samples next to each other in the fluid, no facet between them: a body that is thinner
    /// than samples are far from each other has fluid on both sides.
    bool
    are_joined(const GridIndex<dim> &one, const GridIndex<dim> &other) const;

    /// Is no facet between a place and a sample?
    bool
    sees(const dealii::Point<dim> &place, const GridIndex<dim> &index) const;

    /// From sample to neighbouring sample, the first one taken for zero.
    void
    find_relative_windings();

    /// The number to add to relative windings, from a corner that is not on the surface or, if
    /// there is none, by the majority of corners.
    int
    first_winding(const CornerWindings         &corner_windings,
                  const dealii::Tensor<1, dim> &lower_shifts) const;

    bool
    has_facet_near(const dealii::Point<dim> &place) const;

    int
    winding(const dealii::Point<dim> &place) const;

    /// Give region number `region` to all samples joined to `start`.
    void
    flood(const GridIndex<dim> &start, const int region);

    dealii::Point<dim>     lower;
    dealii::Tensor<1, dim> widths;
    IndexBox<dim>          samples; ///< and bins
    std::vector<Facet>     facets;
    std::vector<int>       windings;  ///< of the samples
    std::vector<int>       region_of; ///< of each sample; -1 solid, -2 not yet known
    std::vector<Region>    all_regions;

    std::vector<std::vector<int>> facets_in; ///< each bin
  };


  /// Sample the fluid in cell number `cell` of cut.cells, given its fragments.
  template <int dim>
  SampledRegions<dim>
  sample_fluid(const CutCells<dim> &cut, const int cell);


  /// Append the pieces of the last face by sampling.
  void
  sample_face(CutCells<3> &cut, CutWorkspace<3> &work);


  /// Replace the components of the last cell by sampled ones. Of every fragment the part that is
  /// wet goes to the nearest component: surfaces inside another body have no surface flux. Closure
  /// is lost until close_sampled_cells().
  template <int dim>
  void
  sample_cell(CutCells<dim> &cut, const CutWorkspace<dim> &work);
} // namespace undine

#endif
