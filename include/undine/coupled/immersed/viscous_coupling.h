// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_coupled_immersed_viscous_coupling_h
#define undine_coupled_immersed_viscous_coupling_h

#include <undine/coupled/immersed/linearised_bodies.h>
#include <undine/coupled/state/state.h>
#include <undine/fluid/fluid_stage.h>

#include <memory>
#include <optional>
#include <vector>

namespace undine
{
  /// The coupling of surfaces in the fluid with its viscous forces, stage by stage: no-slip
  /// surfaces, how the bodies answer to friction (LinearisedBodies), and the forces that result.
  template <int dim>
  class ViscousCoupling
  {
  public:
    using Vectors = std::vector<dealii::Tensor<1, dim>>;

    /// The models must outlive it. Without friction it does nothing. Collective.
    explicit ViscousCoupling(const Models<dim> &models);

    /// The no-slip surfaces of the grid as it is cut now. Collective.
    std::shared_ptr<const NoSlipSurfaces<dim>>
    walls(const FluidGeometry<dim> &geometry);

    /// If friction moves bodies, the other loads of the fluid on them are kept, as they are at
    /// `time` [s] for the grid as it is cut now. Collective.
    void
    keep_loads(State<dim>                   &state,
               const FluidGeometry<dim>     &geometry,
               const dealii::Tensor<1, dim> &gravity,
               double                        time) const;

    /// How the bodies answer in a stage that begins, as long as this lives, in a fluid with
    /// `viscosity` [Pa s]; nullptr if friction moves none. Collective. Throws SolveError.
    std::unique_ptr<BodyImpedance<dim>>
    impedance(const State<dim>            &state,
              const FluidGeometry<dim>    &geometry,
              const SolidEnvironment<dim> &environment,
              const Stage                 &stage,
              double                       viscosity,
              TimingTree                  &timing);

    /// The stage has ended with `state`. Collective.
    void
    end(const FluidStage<dim> &fluid, const State<dim> &state, const FluidGeometry<dim> &geometry);

    /// About how much the forces of friction in the last stage would differ if bodies had moved as
    /// fast as friction took them to, in proportion to the forces of friction and pressure on them.
    double
    defect() const
    {
      return last_defect;
    }

    /// Friction of the last stage on all nodes [N]; empty without friction.
    const Vectors &
    forces() const
    {
      return last_forces;
    }

  private:
    bool
    moves_bodies() const;

    const Models<dim>                                     &models;
    typename SolidModel<dim>::Matrix                       mass;
    std::optional<typename LinearisedBodies<dim>::Solvers> solvers; ///< if it moves bodies
    std::shared_ptr<const FluidTopology<dim>>              cut_by;
    std::shared_ptr<const NoSlipSurfaces<dim>> known_surfaces; ///< of the grid that is cut so
    Vectors                                    last_forces;
    double                                     last_defect = 0;
  };
} // namespace undine

#endif
