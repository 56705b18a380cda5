// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/output/probe.h>
#include <undine/solid/solid_point.h>

namespace undine
{
  /// A material point of a body: displacement [m] and velocity [m/s].
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
    columns(const Models<dim> &, const State<dim> &state) const override
    {
      const auto displacement = material_point->value(state.solid.displacement);
      const auto velocity     = material_point->value(state.solid.velocity);
      Columns    result;
      for (unsigned int axis = 0; axis < dim; ++axis)
        result.push_back({name + " displacement " + char('x' + axis), "m", displacement[axis]});
      for (unsigned int axis = 0; axis < dim; ++axis)
        result.push_back({name + " velocity " + char('x' + axis), "m/s", velocity[axis]});
      return result;
    }

  private:
    void
    check_body(const Options &options, const Models<dim> &models) const
    {
      std::string names;
      if (models.solid)
        for (const auto &candidate : models.solid->bodies())
          {
            if (candidate.name == body)
              return;
            names += (names.empty() ? "" : " | ") + candidate.name;
          }
      throw options.error("Body",
                          "there is no body '" + body + "'",
                          names.empty() ? "The scene has no bodies." : "Allowed: " + names);
    }

    std::string                      name;
    std::string                      body;
    dealii::Point<dim>               point;
    std::unique_ptr<SolidPoint<dim>> material_point;
  };


  namespace
  {
    const RegisterForDimensions<Probe, BodyPoint>
      body_point("body point", "displacement and velocity of a material point of a body");
  }
} // namespace undine
