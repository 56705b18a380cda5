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
  /// The grid as the surfaces of everything in the fluid cut it, at the beginning of a step.
  /// Nothing is done again as long as nothing moves.
  template <int dim>
  class FluidGeometry
  {
  public:
    using Positions  = std::vector<dealii::Point<dim>>;
    using Velocities = std::vector<dealii::Tensor<1, dim>>;

    /// For a scene with a surface in the fluid. The models must outlive it.
    explicit FluidGeometry(const Models<dim> &models);

    /// Cut. The surfaces are at `now` and move with `velocities`; when the fields of the fluid were
    /// computed they were at `before`. Collective. Throws SolveError if the surfaces are beyond
    /// use.
    void
    place(const Positions &before, const Positions &now, const Velocities &velocities);

    typename CharacteristicTracer<dim>::Bodies
    bodies() const;

    /// Do bodies and obstacles leave any fluid in the domain? Collective.
    bool
    has_fluid() const;

    /// Are the surfaces where they were when the fields of the fluid were computed?
    bool
    is_unmoved() const
    {
      return positions == was_at;
    }

    /// Of all nodes, where place() was told that they are now.
    const Positions &
    surface_positions() const
    {
      return positions;
    }

    /// As place() was told.
    const Velocities &
    surface_velocities() const
    {
      return velocities;
    }

    /// Of this rank's block, with a halo.
    const CutCells<dim> &
    cut_cells() const
    {
      return cells;
    }

    /// What they leave to the fluid.
    const CutTopology<dim> &
    cut_topology() const
    {
      return parts;
    }

    /// B at the place where the surfaces are.
    const BoundaryFlux<dim> &
    boundary_flux() const
    {
      return *flux_operator;
    }

    /// What the surfaces push out of each component of the fluid in a step of dt [s]; moving with
    /// the velocities given, or as place() was told. @{
    SweptVolumeFlux
    swept_volume_flux(const Velocities &velocities, double dt) const;
    SweptVolumeFlux
    swept_volume_flux(double dt) const;
    /// @}

    /// The same at the start of a run, when nothing has pushed yet: bodies that close a chamber are
    /// taken to yield at once to what flows in.
    SweptVolumeFlux
    initial_swept_volume_flux(double dt) const;

    /// In all nodes the forces of the fluid's reduced pressure, J p = B^T p [N]. Collective.
    Velocities
    pressure_forces(const Field<dim> &pressure) const;

    /// In all nodes what else the fluid does to the surfaces: the weight that the reduced pressure
    /// leaves out, and the pressures of void regions at `time` [N]. Collective.
    Velocities
    other_forces(const dealii::Tensor<1, dim> &gravity, double time) const;

    /// Forces of the pressure at `time` on each body [N], with g also their parts; those of
    /// friction in the nodes, if given; and how the cutting went. Collective.
    Columns
    columns(const Field<dim>             &pressure,
            const dealii::Tensor<1, dim> &gravity,
            double                        time,
            const Velocities             &friction = {}) const;

    /// How the cutting went: what is wrong with the surfaces, where.
    const CutReport &
    cut_report() const
    {
      return last_report;
    }

    /// Of the lists of cut cells, pieces, components and entries of B, on this rank [bytes].
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

    const ImmersedSurface<dim>                &surface;
    const FluidModel<dim>                     &model;
    const VoidRegions<dim>                    *void_regions; ///< nullptr: none
    VoidMask                                   voids;        ///< for `positions`
    Positions                                  positions;    ///< for which `cells` holds
    Positions                                  was_at;       ///< as place() was told
    Velocities                                 velocities;
    CutCells<dim>                              cells;
    CutWorkspace<dim>                          work;
    CutTopology<dim>                           parts;
    CutReport                                  last_report;
    std::unique_ptr<const BoundaryFlux<dim>>   flux_operator;
    std::unique_ptr<const SurfaceQueries<dim>> queries;
  };

  /// The grid as it was cut when the fluid's fields of a state were computed, with surfaces that
  /// stand still. nullptr if nothing stands in the fluid. Collective. Throws SolveError as place()
  /// does.
  template <int dim>
  std::unique_ptr<FluidGeometry<dim>>
  geometry_of(const Models<dim> &models, const State<dim> &state);
} // namespace undine

#endif
