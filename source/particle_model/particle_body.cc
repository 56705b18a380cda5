// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/particle_model/particle_body.h>
#include <undine/solid/material/elastic_constants.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace undine
{
  namespace
  {
    constexpr double rounding_in_bodies = 1e-6; // [spacings]


    particles::Law
    choose_law(const Options &options)
    {
      using particles::Law;
      const std::map<std::string, Law> laws{
        {"corotated", Law::corotated},
        {"linear elastic", Law::linear_elastic},
        {"Saint Venant-Kirchhoff", Law::saint_venant_kirchhoff},
        {"neo-Hookean", Law::neo_hookean},
        {"nearly incompressible rubber", Law::nearly_incompressible_rubber}};
      std::vector<std::string> words;
      for (const auto &law : laws)
        words.push_back(law.first);
      std::string word = "corotated";
      options.add("Material",
                  word,
                  "",
                  Allowed::one_of(words),
                  "The law between strain and stress. corotated: Hooke's law in the stretches of "
                  "each particle; the others are those of finite elements.");
      return laws.at(word);
    }


    template <int dim>
    std::vector<BodyBoundary<dim>>
    read_clamped_parts(const Options &section)
    {
      std::vector<BodyBoundary<dim>> result;
      for (const auto &name : section.named_sections("root"))
        {
          const auto options = section.section(name);
          if (options.is_reference())
            continue; // the keys are those of the other bodies
          result.emplace_back(name, options);
          if (result.back().kind != BodyBoundary<dim>::Kind::clamp)
            throw options.error(
              "Kind", "is not possible for a body of particles", "Allowed: clamp.");
        }
      return result;
    }


    /// The facets of the sides that a boundary names.
    template <int dim>
    Surface<dim>
    named_part(const BodyBoundary<dim> &boundary, const ShapeBoundary<dim> &shape)
    {
      std::vector<typename Surface<dim>::Facet> facets;
      for (const auto &name : boundary.sides)
        {
          const auto side = shape.side_names.find(name);
          if (side == shape.side_names.end())
            {
              std::string all;
              for (const auto &other : shape.side_names)
                all += (all.empty() ? "" : " | ") + other.first;
              throw boundary.options.error(
                "Sides",
                "names a side '" + name + "' that the shape does not have",
                all.empty() ? "A surface from a file has no sides: use 'Where'."
                            : "Allowed: " + all);
            }
          for (std::size_t k = 0; k < shape.facets.size(); ++k)
            if (shape.sides[k] == side->second)
              facets.push_back(shape.facets[k]);
        }
      if (facets.empty()) // none named: all
        facets = shape.facets;
      return Surface<dim>(
        shape.nodes.size(), facets, std::vector<unsigned int>(facets.size(), 0), {""});
    }
  } // namespace


  template <int dim>
  ParticleBody<dim>::ParticleBody(const std::string &name, const Options &options)
    : name(name)
    , options(options)
    , description(name, options)
  {
    options.require(
      "Density", setup.density, "kg/m^3", Allowed::positive(), "Mass per volume at rest.");
    ElasticConstants constants;
    setup.law = choose_law(options);
    constants.add_options(options);
    setup.youngs_modulus = constants.youngs_modulus;
    setup.poissons_ratio = constants.poissons_ratio;
    options.add("Initial displacement",
                displacement,
                "m",
                Allowed::constant_in_time(),
                "At t = 0, of the point that rests at x.");
    options.add("Initial velocity",
                velocity,
                "m/s",
                Allowed::constant_in_time(),
                "At t = 0, of the point that rests at x.");
    options.add("Hourglass stiffness",
                setup.hourglass,
                "1",
                Allowed::not_negative(),
                "Against motions of particles that the gradient of deformation does not see, as "
                "share of the shear modulus. With more than 1 explicit steps become shorter.");
    options.add("Bond damping",
                setup.damping,
                "1",
                Allowed::between(0, 1),
                "Of neighbours' relative motion, as share of the critical one.");
    options.add("Bulk damping",
                setup.bulk_damping,
                "1",
                Allowed::between(0, 2),
                "Of sound in the body, as share of rho c_p l0, c_p the speed of pressure waves.");
    options.add(
      "Contact modulus",
      setup.contact_modulus,
      "Pa",
      Allowed::not_negative(),
      "Stiffness with which other bodies and walls are kept off, as stress per overlap in "
      "spacings; the softer one of two bodies counts. 0: that of pressure waves, lambda + 2 mu.");
    boundaries = read_clamped_parts<dim>(options.section("Boundaries"));
  }


  template <int dim>
  void
  ParticleBody<dim>::fill(const double spacing)
  {
    const auto shape       = make_shape_boundary(description);
    const auto all_of_body = shape.surface(name);
    check_closed(all_of_body, shape.nodes);
    volume = body_volumes(all_of_body, shape.nodes)[0];
    place_in(SurfaceDistance<dim>(all_of_body, shape.nodes), spacing);
    clamped.assign(places.size(), 0);
    for (const auto &boundary : boundaries)
      hold(boundary, shape, spacing);
    start(shape.nodes, all_of_body);
  }


  template <int dim>
  void
  ParticleBody<dim>::place_in(const SurfaceDistance<dim> &shape, const double spacing)
  {
    const auto                    box = shape.box();
    std::array<unsigned int, dim> count, index{};
    dealii::Point<dim>            first;
    for (unsigned int axis = 0; axis < dim; ++axis)
      {
        const double cubes = std::max(1., std::round(box.side_length(axis) / spacing));
        if (cubes > 1e5)
          throw options.error("",
                              fmt::format("the body is {:.3g} spacings long", cubes),
                              "Try: a larger 'Particles / Spacing'.");
        count[axis] = cubes;
        first[axis] = box.center()[axis] - (cubes - 1) / 2 * spacing;
      }
    for (unsigned int axis = 0; axis < dim;)
      {
        auto place = first;
        for (unsigned int d = 0; d < dim; ++d)
          place[d] += index[d] * spacing;
        if (shape.nearest(place).distance < -rounding_in_bodies * spacing)
          places.push_back(place);
        for (axis = 0; axis < dim && ++index[axis] == count[axis]; ++axis)
          index[axis] = 0;
      }
    if (places.empty())
      throw options.error(
        "", "the body is smaller than a particle", "Try: a smaller 'Particles / Spacing'.");
  }


  template <int dim>
  void
  ParticleBody<dim>::start(std::vector<dealii::Point<dim>> nodes, const Surface<dim> &boundary)
  {
    const auto finite = [&](const std::string          &key,
                            const Expression<dim, dim> &expression,
                            const dealii::Point<dim>   &place) {
      const auto value = expression.vector(place, 0.);
      if (!std::isfinite(value.norm()))
        throw options.error(key,
                            "is not a number at (" + write_value(place) + ")",
                            "Try: an expression that is finite in the whole body.");
      return value;
    };
    for (std::size_t k = 0; k < places.size(); ++k)
      {
        starts.push_back(places[k] + finite("Initial displacement", displacement, places[k]));
        velocities.push_back(finite("Initial velocity", velocity, places[k]));
        for (unsigned int axis = 0; axis < dim; ++axis)
          if (clamped[k] >> axis & 1)
            velocities.back()[axis] = 0;
      }
    for (auto &node : nodes)
      node += finite("Initial displacement", displacement, node);
    if (!(body_volumes(boundary, nodes)[0] > 0))
      throw options.error("Initial displacement",
                          "turns the body inside out or leaves no volume",
                          "Try: smaller displacements.");
    surface = std::make_unique<const SurfaceDistance<dim>>(boundary, nodes);
  }


  template <int dim>
  void
  ParticleBody<dim>::hold(const BodyBoundary<dim>  &boundary,
                          const ShapeBoundary<dim> &shape,
                          const double              spacing)
  {
    // 'Where' alone speaks of the whole body: what is embedded in a wall is clamped in all its
    // depth.
    const bool near_surface = !boundary.sides.empty() || !boundary.options.given("Where");
    const SurfaceDistance<dim> part(named_part(boundary, shape), shape.nodes);
    unsigned char              directions = 0;
    for (unsigned int axis = 0; axis < dim; ++axis)
      directions |= boundary.directions[axis] ? 1 << axis : 0;
    bool any = false;
    for (std::size_t k = 0; k < places.size(); ++k)
      {
        const double where = boundary.where.value(places[k], 0.);
        if (!std::isfinite(where))
          throw boundary.options.error("Where",
                                       "is not a number at (" + write_value(places[k]) + ")",
                                       "Try: an expression that is finite in the whole body.");
        if (where > 0 && (!near_surface || std::abs(part.nearest(places[k]).distance) <
                                             (1 - rounding_in_bodies) * spacing))
          {
            clamped[k] |= directions;
            any = true;
          }
      }
    if (!any)
      throw boundary.options.error(
        "Where",
        "together with 'Sides' holds no particle of the body",
        "Try: another expression or side; particles within one spacing of "
        "the sides are clamped, without sides all at which 'Where' is "
        "positive.");
  }


  template <int dim>
  std::vector<ParticleBody<dim>>
  read_particle_bodies(const Options &scene)
  {
    const auto                     section = scene.section("Bodies");
    std::vector<ParticleBody<dim>> result;
    for (const auto &name : section.named_sections("beam"))
      section.section(name).attempt([&] { result.emplace_back(name, section.section(name)); });
    return result;
  }


  template struct ParticleBody<2>;
  template struct ParticleBody<3>;
  template std::vector<ParticleBody<2>>
  read_particle_bodies(const Options &);
  template std::vector<ParticleBody<3>>
  read_particle_bodies(const Options &);
} // namespace undine
