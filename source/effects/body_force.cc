// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/effects/effect.h>
#include <undine/effects/face_forces.h>
#include <undine/solid/mesh/solid_model.h>

#include <algorithm>

namespace undine
{
  /// A force that the scene prescribes (E7), as a function of place and time: on the fluid,
  /// explicit at the end of the step, and on bodies that it names, there of the place at rest. Its
  /// work is sum rho V h a (v + h a / 2) on the fluid and int f dX times the change of d on bodies.
  ///
  /// Where bodies cut the grid a force acts as pressure does, see acting_on_piece().
  template <int dim>
  class BodyForce : public Effect<dim>
  {
  public:
    void
    add_options(const Options &options) override
    {
      read_force(on_fluid, options.section("Fluid"), "x, y(, z) and t");
      const auto bodies = options.section("Bodies");
      for (const auto &name : bodies.named_sections("beam"))
        {
          VolumeForce<dim> force;
          force.body = name;
          read_force(force, bodies.section(name), "the place at rest and t");
          on_bodies.push_back(force);
        }
    }

    void
    check(const Options &options, const typename Effect<dim>::Surroundings &around) const override
    {
      const auto fluid  = options.section("Fluid");
      const auto bodies = options.section("Bodies");
      if (!fluid.given() && on_bodies.empty())
        throw options.error("",
                            "names nothing on which a force acts",
                            "Add a subsection 'Fluid', or 'Bodies' with the name of a body.");
      if (fluid.given())
        check_force(on_fluid, fluid);
      if (fluid.given() && !around.fluid)
        throw fluid.error(
          "", "acts on a fluid, but the scene has none", "Remove it or add a section 'Fluid'.");
      for (const auto &force : on_bodies)
        {
          check_force(force, bodies.section(force.body));
          check_body(bodies.section(force.body), force.body, around.solid);
        }
    }

    std::pair<std::string, std::string>
    reason_not_for_particles() const override
    {
      return {"particles do not know forces that depend on place and time",
              "Try: 'gravity' or 'central attraction', or compute the scene on a "
              "grid: 'Scheme = simultaneous'."};
    }

    std::string
    summary() const override
    {
      std::string text = is_zero(on_fluid) ? "" : "fluid: " + describe(on_fluid);
      for (const auto &force : on_bodies)
        text += (text.empty() ? "" : "; ") + force.body + ": " + describe(force);
      return text;
    }

    void
    accelerate(FluidStage<dim> &step) const override
    {
      if (is_zero(on_fluid))
        return;
      const auto  timed = step.timing.section(this->name);
      const auto &grid  = step.model.grid();
      for (unsigned int axis = 0; axis < dim; ++axis)
        {
          const auto &component = step.state.velocity[axis];
          accelerate_faces(
            step,
            axis,
            [&](const auto &face) {
              return acceleration(step, component.lattice().point(face))[axis];
            },
            [&](const unsigned int piece) {
              const auto &part = component.divided()->all()[piece];
              return acting_on_piece(
                grid, *component.topology(), axis, piece, acceleration(step, part.place));
            });
        }
    }

    void
    affect(SolidEnvironment<dim> &environment) const override
    {
      for (const auto &force : on_bodies)
        {
          environment.forces.push_back(force);
          environment.forces.back().effect = this->name;
        }
    }

  private:
    /// Of the fluid [m/s^2].
    dealii::Tensor<1, dim>
    acceleration(const FluidStage<dim> &step, const dealii::Point<dim> &place) const
    {
      return on_fluid.acceleration.vector(place, step.end) +
             on_fluid.per_volume.vector(place, step.end) / step.model.density();
    }


    static void
    read_force(VolumeForce<dim> &force, const Options &options, const std::string &arguments)
    {
      options.add("Acceleration",
                  force.acceleration,
                  "m/s^2",
                  Allowed::anything(),
                  "Force per mass, as a function of " + arguments + ".");
      options.add("Force per volume",
                  force.per_volume,
                  "N/m^3",
                  Allowed::anything(),
                  "The same for a force per volume.");
    }


    static bool
    is_zero(const VolumeForce<dim> &force)
    {
      return force.acceleration.is_zero() && force.per_volume.is_zero();
    }


    static void
    check_force(const VolumeForce<dim> &force, const Options &options)
    {
      if (options.given("Acceleration") && options.given("Force per volume"))
        throw options.error("Force per volume",
                            "is given beside 'Acceleration'",
                            "Keep one of them: an acceleration times the density is a force per "
                            "volume.");
      if (is_zero(force))
        throw options.error("",
                            "the force is zero everywhere",
                            "Set 'Acceleration' or 'Force per volume', or remove the section.");
    }


    static void
    check_body(const Options &options, const std::string &name, const SolidModel<dim> *solid)
    {
      std::string known;
      if (solid)
        for (const auto &body : solid->bodies())
          {
            if (body.name == name)
              return;
            known += (known.empty() ? "'" : ", '") + body.name + "'";
          }
      throw options.error("",
                          "the scene has no body of this name",
                          known.empty() ? "Remove it or add a section 'Bodies'."
                                        : "Allowed: " + known);
    }


    static std::string
    describe(const VolumeForce<dim> &force)
    {
      return force.per_volume.is_zero() ? "(" + force.acceleration.text() + ") m/s^2"
                                        : "(" + force.per_volume.text() + ") N/m^3";
    }

    VolumeForce<dim>              on_fluid;
    std::vector<VolumeForce<dim>> on_bodies;
  };


  namespace
  {
    const RegisterForDimensions<Effect, BodyForce>
      registered_body_force("body force", "A prescribed force on the fluid and on bodies.");
  }
} // namespace undine
