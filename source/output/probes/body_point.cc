// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/output/probes/particle_queries.h>
#include <undine/output/probes/probe.h>
#include <undine/solid/mesh/solid_point.h>

#include <algorithm>

namespace undine
{
  /// A material point of a body, or its particle nearest to it: displacement [m] and velocity
  /// [m/s].
  template <int dim>
  class BodyPoint : public Probe<dim>
  {
  public:
    void
    add_options(const Options &options) override
    {
      options.require(
        "Body", body, "", Allowed::anything(), "Name of the body that the point belongs to.");
      options.require(
        "Point", point, "m", Allowed::anything(), "Position of the material point at rest.");
    }

    void
    start(const std::string &probe_name, const Options &options, const Models<dim> &models) override
    {
      name = probe_name;
      if (models.particles)
        return start_of_particles(options, *models.particles);
      check_body(options, models);
      try
        {
          material_point = std::make_unique<SolidPoint<dim>>(*models.solid, body, point);
        }
      catch (const InputError &error)
        {
          throw options.error("Point", error.what(), "Allowed: points of the body at rest [m]");
        }
    }

    Columns
    columns(const Models<dim> &models, const State<dim> &state) const override
    {
      dealii::Tensor<1, dim> displacement, velocity;
      if (models.particles)
        {
          const auto k     = place_of_identity(state.particles, identity);
          const auto moved = particles::displacement(
            state.particles, k, models.particles->setup().reference[identity]);
          for (unsigned int axis = 0; axis < dim; ++axis)
            {
              displacement[axis] = moved[axis];
              velocity[axis]     = state.particles.velocities[k][axis];
            }
        }
      else
        {
          displacement = material_point->value(state.solid.displacement);
          velocity     = material_point->value(state.solid.velocity);
        }
      Columns result;
      for (unsigned int axis = 0; axis < dim; ++axis)
        result.push_back({name + " displacement " + char('x' + axis), "m", displacement[axis]});
      for (unsigned int axis = 0; axis < dim; ++axis)
        result.push_back({name + " velocity " + char('x' + axis), "m/s", velocity[axis]});
      return result;
    }

  private:
    /// The particle that is nearest at rest, which must stand for the place.
    void
    start_of_particles(const Options &options, const ParticleModel<dim> &model)
    {
      const auto &bodies = model.body_names();
      const auto  number = std::find(bodies.begin(), bodies.end(), body) - bodies.begin();
      if (number == static_cast<std::ptrdiff_t>(bodies.size()))
        throw no_body(options, bodies);
      identity = nearest_of_body(model, number, point);
      dealii::Point<dim> place;
      for (unsigned int axis = 0; axis < dim; ++axis)
        place[axis] = model.setup().reference[identity][axis];
      if (place.distance(point) > model.domain().spacing)
        throw options.error("Point",
                            "is farther than a spacing from all particles of the body",
                            "The nearest one is at (" + write_value(place) + ") m.");
    }

    InputError
    no_body(const Options &options, const std::vector<std::string> &bodies) const
    {
      std::string names;
      for (const auto &candidate : bodies)
        names += (names.empty() ? "" : " | ") + candidate;
      return options.error("Body",
                           "there is no body '" + body + "'",
                           names.empty() ? "The scene has no bodies." : "Allowed: " + names);
    }

    void
    check_body(const Options &options, const Models<dim> &models) const
    {
      std::vector<std::string> names;
      if (models.solid)
        for (const auto &candidate : models.solid->bodies())
          names.push_back(candidate.name);
      if (std::find(names.begin(), names.end(), body) == names.end())
        throw no_body(options, names);
    }

    std::string                      name;
    std::string                      body;
    dealii::Point<dim>               point;
    std::unique_ptr<SolidPoint<dim>> material_point; ///< of finite elements
    int                              identity = 0;   ///< of particles
  };


  namespace
  {
    const RegisterForDimensions<Probe, BodyPoint>
      body_point("body point", "displacement and velocity of a material point of a body");
  }
} // namespace undine
