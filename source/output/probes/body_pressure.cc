// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/output/probes/particle_queries.h>
#include <undine/output/probes/probe.h>

#include <algorithm>
#include <cmath>

namespace undine
{
  /// The pressure of the fluid on a body of particles around a material point, averaged [Pa].
  template <int dim>
  class BodyPressure : public Probe<dim>
  {
  public:
    void
    add_options(const Options &options) override
    {
      options.require("Body", body, "", Allowed::anything(), "Name of the body.");
      options.require("Point",
                      point,
                      "m",
                      Allowed::anything(),
                      "Position of a point of its surface at rest, which it takes along.");
      options.add("Radius",
                  radius,
                  "m",
                  Allowed::not_negative(),
                  "The body's particles that are nearer to the point at rest count; at least those "
                  "within a spacing.");
    }

    void
    start(const std::string &probe_name, const Options &options, const Models<dim> &models) override
    {
      name = probe_name;
      if (!models.particles)
        throw options.error("Kind",
                            "measures bodies of particles, but the scene has none",
                            "Try: 'body point', or 'Scheme = particle'.");
      const auto &model  = *models.particles;
      const auto &names  = model.body_names();
      const auto  number = std::find(names.begin(), names.end(), body) - names.begin();
      if (number == static_cast<std::ptrdiff_t>(names.size()))
        {
          std::string all;
          for (const auto &candidate : names)
            all += (all.empty() ? "" : " | ") + candidate;
          throw options.error("Body",
                              "there is no body '" + body + "'",
                              all.empty() ? "The scene has no bodies." : "Allowed: " + all);
        }
      const auto  &setup  = model.setup();
      const double within = (1 + 1e-6) * std::max(radius, model.domain().spacing);
      for (std::size_t k = 0; k < setup.reference.size(); ++k)
        {
          double square = 0;
          for (unsigned int axis = 0; axis < dim; ++axis)
            square += std::pow(setup.reference[k][axis] - point[axis], 2);
          if (setup.body_of[k] == number && square <= within * within)
            identities.push_back(k); // ascending
        }
      if (identities.empty())
        throw options.error("Point",
                            "no particle of the body is near (" + write_value(point) + ")",
                            "Try: a point of the body at rest, or a larger radius.");
    }

    Columns
    columns(const Models<dim> &models, const State<dim> &state) const override
    {
      return {
        {name + " pressure", "Pa", mean_pressure(*models.particles, state.particles, identities)}};
    }

  private:
    std::string        name, body;
    dealii::Point<dim> point;
    double             radius = 0; ///< [m]
    std::vector<int>   identities;
  };


  namespace
  {
    const RegisterForDimensions<Probe, BodyPressure>
      body_pressure("body pressure", "pressure of the fluid on a body of particles");
  }
} // namespace undine
