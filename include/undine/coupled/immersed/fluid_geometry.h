// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_coupled_immersed_fluid_geometry_h
#define undine_coupled_immersed_fluid_geometry_h

#include <undine/base/core/column.h>
#include <undine/base/core/timing.h>
#include <undine/coupled/model/models.h>
#include <undine/coupled/state/state.h>
#include <undine/cutting/cut_block.h>
#include <undine/cutting/cut_report.h>
#include <undine/fluid/advection/characteristic_tracer.h>
#include <undine/operators/boundary_flux.h>
#include <undine/operators/cut_topology.h>
#include <undine/operators/void_regions.h>
#include <undine/surface/immersed_surface.h>
#include <undine/surface/surface_queries.h>

#include <memory>
#include <vector>

namespace undine
{
  /// The grid as cut by the surfaces of all bodies and obstacles where place() puts them: in a
  /// stage that keeps rates where they will be at its end, else where they are at its beginning
  /// (Stage::ahead). As long as nothing moves, nothing is computed anew.
  template <int dim>
  class FluidGeometry
  {
  public:
    using Positions  = std::vector<dealii::Point<dim>>;
    using Velocities = std::vector<dealii::Tensor<1, dim>>;

    /// For a scene with a surface in the fluid. The models must outlive it.
    explicit FluidGeometry(const Models<dim> &models);

    /// Cut the grid by surfaces whose nodes are at `now` [m] and move with `velocities` [m/s]; when
    /// the fields of the fluid were computed they were at `before`. Collective. Throws SolveError
    /// if positions are not finite, a body is inside out or at a periodic side, or a void region is
    /// ill-posed.
    void
    place(const Positions &before, const Positions &now, const Velocities &velocities);

    /// What characteristic tracing needs of the bodies; without no-slip surfaces.
    typename CharacteristicTracer<dim>::Bodies
    bodies() const;

    /// Do bodies and obstacles leave any fluid in the domain? The same on all ranks.
    bool
    has_fluid() const
    {
      return fluid_is_left;
    }

    /// Are the surfaces where they were when the fields of the fluid were computed?
    bool
    is_unmoved() const
    {
      return positions == was_at;
    }

    /// `now` of place(): positions of all nodes [m].
    const Positions &
    surface_positions() const
    {
      return positions;
    }

    /// Where the nodes were put to cut the grid, see beyond_planes() [m].
    const Positions &
    cut_positions() const
    {
      return cut_at;
    }

    /// `velocities` of place() [m/s].
    const Velocities &
    surface_velocities() const
    {
      return velocities;
    }

    /// The cut cells of this rank's block, with a halo.
    const CutCells<dim> &
    cut_cells() const
    {
      return cells;
    }

    /// The topology that they leave to the fluid.
    const CutTopology<dim> &
    cut_topology() const
    {
      return parts;
    }

    /// B of the surfaces at their present positions.
    const BoundaryFlux<dim> &
    boundary_flux() const
    {
      return *flux_operator;
    }

    /// The swept-volume flux of the surfaces out of each component of the fluid in a step of dt
    /// [s]; with the B and velocities given, or with those of place(). @{
    SweptVolumeFlux
    swept_volume_flux(const BoundaryFlux<dim> &boundary_flux,
                      const Velocities        &velocities,
                      double                   dt) const;
    SweptVolumeFlux
    swept_volume_flux(const Velocities &velocities, double dt) const;
    SweptVolumeFlux
    swept_volume_flux(double dt) const;
    /// @}

    /// The same at the start of a run: compliant bodies around a closed region give way at once to
    /// what flows in, in proportion to their area.
    SweptVolumeFlux
    initial_swept_volume_flux(double dt) const;

    /// In all nodes the forces of the fluid's reduced pressure, J p = B^T p [N]. Collective.
    Velocities
    pressure_forces(const Field<dim> &pressure) const;

    /// The same of pressures of the components, [CutTopology::open->cells] [Pa]. Collective.
    Velocities
    pressure_forces(const std::vector<double> &pressures) const;

    /// The same of a uniform pressure [Pa]. Collective.
    Velocities
    uniform_pressure_forces(double pressure) const;

    /// rho g.x in the centroids of the components, [CutTopology::open->cells] [Pa].
    std::vector<double>
    static_pressures(const dealii::Tensor<1, dim> &gravity) const;

    /// Pressures of void regions at `time` [s] in the components of cut cells, zero in the fluid
    /// [CutCells::components] [Pa]; empty without void regions.
    std::vector<double>
    void_pressures(double time) const;

    /// What is outside of openings presses with at `time` [s], on each facet where the grid was
    /// cut, see outside_pressures_on_facets() [Pa].
    std::vector<double>
    outside_pressures_on_facets(const dealii::Tensor<1, dim> &gravity, double time) const;

    /// All other forces in the nodes of the surfaces but friction [N]: the weight that the reduced
    /// pressure leaves out, the pressures of void regions at `time` [s], and those outside of
    /// openings. Collective.
    Velocities
    other_forces(const dealii::Tensor<1, dim> &gravity, double time) const;

    /// For `statistics`: forces of the pressure at `time` [s] on each body [N], with gravity also
    /// their two parts; those of friction, if `friction` in the nodes [N] is given; and the numbers
    /// of cut and flagged cells. Collective.
    Columns
    columns(const Field<dim>             &pressure,
            const dealii::Tensor<1, dim> &gravity,
            double                        time,
            const Velocities             &friction = {}) const;

    /// Statistics of the cutting, and what is wrong with the surfaces and where.
    const CutReport &
    cut_report() const
    {
      return last_report;
    }

    /// May there be regions that are no part of the fluid (VoidRegions)?
    bool
    has_void_regions() const
    {
      return void_regions != nullptr;
    }

    /// Memory of the lists of cut cells, pieces, components and entries of B on this rank [bytes].
    std::size_t
    memory_consumption() const;

  private:
    void
    cut(const VoidMask &last_voids);
    void
    cut_beyond_planes();
    Velocities
    gravity_forces(const dealii::Tensor<1, dim> &gravity) const;
    Velocities
    void_forces(double time) const;
    Velocities
    outside_forces(const dealii::Tensor<1, dim> &gravity, double time) const;

    const ImmersedSurface<dim>                &surface;
    const FluidModel<dim>                     &model;
    const VoidRegions<dim>                    *void_regions; ///< nullptr: none
    VoidMask                                   voids;        ///< for `positions`
    Positions                                  positions;    ///< for which `cells` holds
    Positions                                  cut_at;       ///< the same beyond planes
    Positions                                  was_at;       ///< as place() was told
    Velocities                                 velocities;
    CutCells<dim>                              cells;
    CutWorkspace<dim>                          work;
    CutTopology<dim>                           parts;
    CutReport                                  last_report;
    bool                                       fluid_is_left = true;
    std::unique_ptr<const BoundaryFlux<dim>>   flux_operator;
    std::unique_ptr<const SurfaceQueries<dim>> queries;
  };

  /// The grid as it was cut when the fluid's fields of a state were computed, with surfaces at
  /// rest. nullptr without a fluid, or if there is no surface in it. Collective. Throws SolveError
  /// as place() does.
  template <int dim>
  std::unique_ptr<FluidGeometry<dim>>
  geometry_of(const Models<dim> &models, const State<dim> &state);
} // namespace undine

#endif
