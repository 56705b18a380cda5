// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_fluid_scalars_scalar_fluxes_h
#define undine_fluid_scalars_scalar_fluxes_h

#include <undine/fluid/boundary/boundary_condition.h>
#include <undine/fluid/boundary/side_faces.h>
#include <undine/fluid/grid/cell_links.h>
#include <undine/fluid/scalars/scalar_flow.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace undine
{
  /// What carries a scalar s through faces and pieces: the flow, and diffusion down the difference
  /// of the values in the middles of cells, cut ones as well; none through surfaces,
  ///
  ///     F = phi s_face + k (s - s'),   k = D a / d                                        (F18)
  ///
  /// out of the cell or component of s, with the area a and the distance d of the middles.
  template <int dim>
  class ScalarFluxes
  {
  public:
    /// How F depends on s and s' if s_face is the value upwind: own >= 0 >= other.
    struct Coefficients
    {
      double own, other; ///< [m^dim/s]
    };

    /// Of a link.
    struct Flux
    {
      double rate;        ///< phi [m^dim/s]
      double conductance; ///< k [m^dim/s]

      Coefficients
      upwind() const
      {
        return {std::max(0., rate) + conductance, std::min(0., rate) - conductance};
      }
    };

    /// Through a side of the domain; s' is `beyond`.
    struct SideFlux : Flux
    {
      FacePlace<dim> face;
      unsigned int   axis;
      double         beyond;
    };

    /// `diffusivity` D [m^2/s]. The references must outlive this.
    ScalarFluxes(const ScalarFlow<dim>        &flow,
                 const BoundaryCondition<dim> &condition,
                 const double                  diffusivity)
      : flow(flow)
      , condition(condition)
      , diffusivity(diffusivity)
    {
      const auto &grid = flow.model().grid();
      const auto *open = flow.topology().get();
      for_each_cell_link(grid, open, [&](const CellLink<dim> &link) {
        const double area = link.area(grid, open);
        rates.push_back(link.sign * area * value_at(flow.velocity()[link.axis], link.face));
        if (diffusivity > 0)
          conductances.push_back(diffusivity * area /
                                 grid.dual_width(link.axis, link.face.face[link.axis]));
      });
    }

    /// action(CellLink, Flux) as for_each_cell_link().
    template <class Action>
    void
    for_each(const Action &action) const
    {
      std::size_t k = 0;
      for_each_cell_link(
        flow.model().grid(), flow.topology().get(), [&](const CellLink<dim> &link) {
          action(link, Flux{rates[k], conductances.empty() ? 0. : conductances[k]});
          ++k;
        });
    }

    /// action(PressurePlace inside, SideFlux) for faces and pieces of this rank on sides of the
    /// domain, with values at `time` [s].
    template <class Action>
    void
    for_each_side(const double time, const Action &action) const
    {
      const auto &model = flow.model();
      const auto &grid  = model.grid();
      const auto *open  = flow.topology().get();
      for_each_side_face(
        grid, open, [&](const SideFace<dim> &face, const dealii::Point<dim> &place) {
          const auto        &boundary    = model.boundaries().at(face.side, face.cell);
          const bool         is_given    = condition.is_dirichlet(boundary);
          const unsigned int axis        = face.side.axis;
          const double       rate        = outward_flux(grid, flow.velocity(), face);
          const double       conductance = is_given
                                             ? diffusivity * std::abs(signed_area(grid, open, face)) /
                                           grid.dual_width(axis, face.face[axis])
                                             : 0.;
          if (rate == 0 && conductance == 0)
            return;
          const bool   counts = rate < 0 || conductance > 0;
          const double beyond = !counts    ? 0.
                                : is_given ? condition.dirichlet_value(boundary, axis, place, time)
                                           : condition.entering_value(place, time);
          action(place_inside(open, face),
                 SideFlux{{rate, conductance}, {face.face, face.piece}, axis, beyond});
        });
    }

    bool
    has_diffusion() const
    {
      return diffusivity > 0;
    }

    /// Largest h D / dx^2 for a time h [s]. Collective.
    double
    diffusion_number(const double h) const
    {
      const auto &grid   = flow.model().grid();
      double      result = 0;
      undine::for_each(grid.cells()->owned(), [&](const GridIndex<dim> &cell) {
        for (unsigned int d = 0; d < dim; ++d)
          result = std::max(result, h * diffusivity / std::pow(grid.cell_width(d, cell[d]), 2));
      });
      return dealii::Utilities::MPI::max(result, grid.communicator());
    }

    const ScalarFlow<dim>        &flow;
    const BoundaryCondition<dim> &condition;

  private:
    const double        diffusivity; ///< [m^2/s]
    std::vector<double> rates;       ///< of links [m^dim/s]
    std::vector<double> conductances;
  };
} // namespace undine

#endif
