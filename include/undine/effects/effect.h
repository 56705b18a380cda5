// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_effects_effect_h
#define undine_effects_effect_h

#include <undine/base/core/column.h>
#include <undine/base/options/options.h>
#include <undine/fluid/fluid_step.h>
#include <undine/particles/setup.h>
#include <undine/solid/solid_environment.h>

#include <memory>
#include <string>
#include <vector>

namespace undine
{
  template <int dim>
  class SolidModel;

  /// One physical effect. A scene calls for it by a subsection of its name in `Effects`; nothing
  /// else switches it on, and an effect that is off does not exist during the run. A new effect is
  /// one new .cc file that overrides what it needs and registers itself.
  template <int dim>
  class Effect
  {
  public:
    /// What the effect may ask about the rest of the scene.
    struct Surroundings
    {
      const FluidModel<dim>   *fluid;         ///< nullptr: none
      const SolidModel<dim>   *solid;         ///< nullptr: none
      bool                     has_obstacles; ///< something stands in the fluid
      std::vector<std::string> effects;       ///< names of those that the scene calls for
      std::vector<std::string> scalars;       ///< names of the scalar fields that are carried
      bool                     has_fluid_particles = false; ///< a fluid, but not on a grid
    };

    virtual ~Effect() = default;

    /// The keys by which a scene calls for the effect. Throws InputError on impossible values.
    virtual void
    add_options(const Options &options) = 0;

    /// Throws InputError, with a hint, if the effect contradicts the rest of the scene.
    virtual void
    check(const Options &options, const Surroundings &surroundings) const;

    /// What it will do, with its values, in a few words: "(0, -9.81) m/s^2 as reduced pressure".
    virtual std::string
    summary() const = 0;

    /// Scalar fields that the effect adds to the fluid's state.
    virtual std::vector<std::string>
    scalars() const;

    /// Set up the fields named by scalars(): initial values.
    virtual void
    initialize(const FluidModel<dim> &model, FluidState<dim> &state) const;

    /// The fluid step runs these three phases for every effect, in this order. @{

    /// Carry velocity and scalars with the flow.
    virtual void
    transport(FluidStep<dim> &step) const;

    /// Add explicit forces: v += h f / rho on the faces.
    virtual void
    accelerate(FluidStep<dim> &step) const;

    /// Implicit terms.
    virtual void
    diffuse(FluidStep<dim> &step) const;
    /// @}

    /// Does it need to know where the planes of the grid meet the surfaces in the fluid?
    virtual bool
    sticks_to_surfaces() const;

    /// Say what the effect does to the bodies.
    virtual void
    affect(SolidEnvironment<dim> &environment) const;

    /// Say what the effect does to particles. Returns false if they do not know it.
    virtual bool
    affect_particles(particles::Setup<dim> &setup) const;

    /// What the effect adds to the file `statistics`.
    virtual Columns
    columns(const FluidModel<dim> &model, const FluidState<dim> &state, double time) const;
  };

  /// The effects that the scene calls for, in alphabetical order of their names.
  template <int dim>
  using Effects = std::vector<std::unique_ptr<Effect<dim>>>;
} // namespace undine

#endif
