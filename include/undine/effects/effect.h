// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_effects_effect_h
#define undine_effects_effect_h

#include <undine/base/core/column.h>
#include <undine/base/options/options.h>
#include <undine/fluid/fluid_stage.h>
#include <undine/particles/setup/setup.h>
#include <undine/solid/assembly/solid_environment.h>

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace undine
{
  template <int dim>
  class SolidModel;

  /// One physical effect. A scene calls for it by a subsection of its name in `Effects`; nothing
  /// else switches it on, and an effect that is off does not exist during the run. A new effect is
  /// one new .cc file that overrides what it needs and registers itself; it times its work in
  /// phases of its own name.
  template <int dim>
  class Effect
  {
  public:
    /// What the effect may ask about the rest of the scene.
    struct Surroundings
    {
      const FluidModel<dim>   *fluid;                 ///< nullptr: none
      const SolidModel<dim>   *solid;                 ///< nullptr: none
      bool                     has_immersed_surfaces; ///< of bodies or obstacles, in the fluid
      std::vector<std::string> effects;               ///< names of those that the scene calls for
      std::vector<std::string> scalars; ///< names of the scalar fields that are advected
      bool                     has_fluid_particles = false; ///< a fluid, but not on a grid
      bool                     has_body_particles  = false; ///< bodies without finite elements
    };

    virtual ~Effect() = default;

    /// The keys by which a scene calls for the effect. Throws InputError on impossible values.
    virtual void
    add_options(const Options &options) = 0;

    /// Choose what the scene leaves to the program, given the names of all effects that it calls
    /// for.
    virtual void
    adapt_to(const std::vector<std::string> &effects);

    /// Throws InputError, with a hint, if the effect contradicts the rest of the scene.
    virtual void
    check(const Options &options, const Surroundings &surroundings) const;

    /// What it will do, with its values, in a few words: "(0, -9.81) m/s^2 as reduced pressure".
    virtual std::string
    summary() const = 0;

    /// The same of a scene of particles.
    virtual std::string
    summary_of_particles() const;

    /// Scalar fields that the effect adds to the fluid's state.
    virtual std::vector<std::string>
    scalars() const;

    /// A scalar field as particles carry it: unmixed.
    struct CarriedScalar
    {
      std::string name;
      /// At a place at the start.
      std::function<double(const dealii::Point<dim> &)> initial;
      /// Of fluid that comes in, at a place and time [s].
      std::function<double(const dealii::Point<dim> &, double)> entering;
      /// How fast it grows at a place and time [1/s]; empty: not.
      std::function<double(const dealii::Point<dim> &, double)> source;
    };

    /// Those of scalars() that particles carry. The functions live as long as the effect.
    virtual std::vector<CarriedScalar>
    carried_scalars() const;

    /// Set the fields named by scalars() to their initial values.
    virtual void
    initialize(const FluidModel<dim> &model, FluidState<dim> &state) const;

    /// The fluid step runs these three phases for every effect, in this order. Collective. @{

    /// Advect velocity and scalars with the flow.
    virtual void
    transport(FluidStage<dim> &step) const;

    /// Add explicit forces: v += h f / rho on the faces.
    virtual void
    accelerate(FluidStage<dim> &step) const;

    /// Implicit terms.
    virtual void
    diffuse(FluidStage<dim> &step) const;
    /// @}

    /// What a stage of a step computes for the effect on every cell of the grid, and whether on the
    /// facets of bodies.
    struct Work
    {
      unsigned int advected    = 0;     ///< fields that the flow advects
      unsigned int implicit    = 0;     ///< fields for which a linear system is solved
      bool         has_contact = false; ///< bodies may touch
    };

    /// For estimates of memory and time before anything is built.
    virtual Work
    work() const;

    /// What exists on this rank for the effect alone: matrices that it keeps, its fields in the
    /// state [bytes]. What it allocates within a phase goes to FluidStage::timing.memory.
    virtual std::size_t
    memory_consumption(const FluidState<dim> &state) const;

    /// Does it need NoSlipSurfaces: where the planes of the grid meet the surfaces in the fluid?
    virtual bool
    needs_no_slip_surfaces() const;

    /// Add what the effect does to the bodies to their environment.
    virtual void
    affect(SolidEnvironment<dim> &environment) const;

    /// Add what the effect does to particles to their setup. Returns false if particles do not have
    /// the effect.
    virtual bool
    affect_particles(particles::Setup<dim> &setup) const;

    /// Do the passes over particles compute it, and spend time on it? Else, if anything, a phase of
    /// its own name does.
    virtual bool
    is_in_passes() const;

    /// Why particles do not have it, and what to try; asked where affect_particles() is false.
    virtual std::pair<std::string, std::string>
    reason_not_for_particles() const;

    /// What the effect adds to the file `statistics`.
    virtual Columns
    columns(const FluidModel<dim> &model, const FluidState<dim> &state, double time) const;

    /// What sides of the domain that move do to the fluid by the effect [W]. Collective.
    virtual double
    power_of_sides(const FluidModel<dim> &model, const FluidState<dim> &state, double time) const;

    /// Sizes of which dimensionless numbers are made; zero: unknown.
    struct Scales
    {
      double viscosity = 0; ///< dynamic [Pa s]
      double lift      = 0; ///< largest relative change of density by advected fields [1]
    };

    /// Raise those that the effect knows of, for what this rank has of the state.
    virtual void
    measure(Scales &scales, const FluidState<dim> &state) const;

    /// By which the scene calls for it. The phases of FluidStage::timing in which it works, and its
    /// memory there, bear this name.
    std::string name;
  };

  /// The effects that the scene calls for, in alphabetical order of their names.
  template <int dim>
  using Effects = std::vector<std::shared_ptr<Effect<dim>>>;

  /// Those of which `section`, the scene's `Effects`, has a subsection, with their keys; for the
  /// reference all. Throws InputError, also for names that nobody has registered.
  template <int dim>
  Effects<dim>
  read_effects(const Options &section);
} // namespace undine

#endif
