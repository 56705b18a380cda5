// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_fluid_viscosity_relaxed_diffusion_h
#define undine_fluid_viscosity_relaxed_diffusion_h

#include <undine/fluid/convection/dual_fluxes.h>
#include <undine/fluid/viscosity/diffusion_problem.h>
#include <undine/fluid/viscosity/neighbour_equations.h>

#include <array>
#include <optional>
#include <vector>

namespace undine
{
  /// The step of ImplicitDiffusion by relaxation, without a matrix, and with convection if asked
  /// for.
  template <int dim>
  class RelaxedDiffusion
  {
  public:
    /// `problem` must outlive it.
    explicit RelaxedDiffusion(const DiffusionProblem<dim> &problem);

    /// s* in `field` becomes s^{n+1} at `time` = t^{n+1}, `dt` = h [s], carried by `fluxes` unless
    /// they are nullptr. Returns the number of sweeps; nothing, and leaves the field as it is,
    /// where it would take long. Collective.
    std::optional<unsigned int>
    step(Field<dim> &field, double time, double dt, const DualFluxes<dim> *fluxes);

    /// Memory of the equations on this rank [bytes].
    std::size_t
    memory_consumption() const;

  private:
    /// Along one direction, from the point before the first owned one on.
    struct Distances
    {
      int                 first;
      std::vector<double> extents; ///< of the volumes around points [m]
      std::vector<double> links;   ///< 1 / distance to the next point [1/m]; 0: there is none

      double
      extent(const int index) const
      {
        return extents[index - first];
      }

      double
      link(const int index) const
      {
        return links[index - first];
      }
    };

    Distances
    distances(unsigned int direction) const;

    void
    couple(unsigned int direction, double dt, const DualFluxes<dim> *fluxes);

    void
    fill_points(const Field<dim> &field);

    void
    add_sides(double time, double dt);

    void
    carry_through_sides(double dt, const DualFluxes<dim> &fluxes);

    void
    keep_prescribed(const Field<dim> &field);

    const DiffusionProblem<dim> &problem;
    std::array<Distances, dim>   along;
    NeighbourEquations<dim>      equations;
  };
} // namespace undine

#endif
