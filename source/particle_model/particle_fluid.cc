// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/particle_model/particle_fluid.h>
#include <undine/surface/surface_distance.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace undine
{
  namespace
  {
    constexpr double rounding_in_fluid = 1e-6; // [spacings]


    template <int dim>
    using Distances = std::vector<std::unique_ptr<const SurfaceDistance<dim>>>;


    /// Boundaries of the shapes, which must be in the domain: fluid beyond it would be left out.
    template <int dim>
    Distances<dim>
    build(const std::vector<ShapeDescription<dim>> &shapes, const ParticleDomain<dim> &domain)
    {
      Distances<dim> result;
      for (const auto &shape : shapes)
        {
          const auto boundary = make_shape_boundary(shape);
          const auto surface  = boundary.surface(shape.name);
          check_closed(surface, boundary.nodes);
          for (const auto &node : boundary.nodes)
            for (unsigned int axis = 0; axis < dim; ++axis)
              if (node[axis] < domain.lower[axis] - rounding_in_fluid * domain.spacing ||
                  node[axis] > domain.upper[axis] + rounding_in_fluid * domain.spacing)
                throw shape.options.error("",
                                          "the fluid reaches out of the domain, to (" +
                                            write_value(node) + ")",
                                          "Allowed: from (" + write_value(domain.lower) + ") to (" +
                                            write_value(domain.upper) + ") [m]");
          result.push_back(std::make_unique<const SurfaceDistance<dim>>(surface, boundary.nodes));
        }
      return result;
    }


    template <int dim>
    bool
    is_in_one(const Distances<dim>     &distances,
              const dealii::Point<dim> &place,
              const double              spacing)
    {
      return std::any_of(distances.begin(), distances.end(), [&](const auto &distance) {
        return distance->box().point_inside(place) &&
               distance->nearest(place).distance < -rounding_in_fluid * spacing;
      });
    }


    template <int dim>
    InputError
    no_number(const Options &options, const std::string &key, const dealii::Point<dim> &place)
    {
      return options.error(key,
                           "is not a number at (" + write_value(place) + ")",
                           "Try: an expression that is finite in the whole domain.");
    }
  } // namespace


  template <int dim>
  ParticleFluid<dim>::ParticleFluid(const Options &scene)
    : options(scene.section("Fluid"))
    , region("1")
  {
    options.require("Density", density, "kg/m^3", Allowed::positive(), "Mass per volume at rest.");
    options.add("Bulk modulus",
                bulk_modulus,
                "Pa",
                Allowed::not_negative(),
                "Pressure per relative loss of volume. 0: incompressible.");
    options.add("Region",
                region,
                "",
                Allowed::constant_in_time(),
                "There is fluid at the start where this is positive, in particles' centres, and no "
                "body or obstacle; by default in the whole domain.");
    options.add("Initial velocity", velocity, "m/s", Allowed::constant_in_time(), "At the start.");
    const auto section = options.section("Shapes");
    for (const auto &name : section.named_sections("column"))
      shapes.emplace_back(name, section.section(name));
    openings = read_particle_openings<dim>(options);
  }


  template <int dim>
  bool
  ParticleFluid<dim>::may_have_surface() const
  {
    return options.given("Region") || !shapes.empty() || options.section("Void regions").given();
  }


  template <int dim>
  void
  ParticleFluid<dim>::fill(const ParticleDomain<dim>                             &domain,
                           const std::function<bool(const dealii::Point<dim> &)> &taken)
  {
    const auto distances = build(shapes, domain);
    domain.for_each_cell([&](const dealii::Point<dim> &place) {
      const double inside = region.value(place, 0.);
      if (!std::isfinite(inside))
        throw no_number(options, "Region", place);
      if (!(inside > 0) || (!shapes.empty() && !is_in_one(distances, place, domain.spacing)) ||
          taken(place))
        return;
      places.push_back(place);
      velocities.push_back(velocity.vector(place, 0.));
      if (!std::isfinite(velocities.back().norm()))
        throw no_number(options, "Initial velocity", place);
    });
    const bool flows_in = std::any_of(openings.begin(), openings.end(), [](const auto &opening) {
      return opening.kind == OpeningKind::inflow;
    });
    if (places.empty() && !flows_in)
      throw options.error(
        "Region",
        shapes.empty() ? "leaves no fluid" : "and the 'Shapes' together leave no fluid",
        "Try: another region, or a smaller 'Particles / Spacing'; a scene without "
        "fluid has no section 'Fluid'.");
  }


  template <int dim>
  typename ParticleFluid<dim>::Sample
  ParticleFluid<dim>::sample(const ParticleDomain<dim>    &domain,
                             const dealii::Tensor<1, dim> &gravity) const
  {
    constexpr double     enough    = 1e5; // cubes
    const auto           distances = build(shapes, domain);
    double               all       = 1;
    std::array<int, dim> stride, index;
    for (const auto n : domain.cells)
      all *= n;
    for (unsigned int axis = 0; axis < dim; ++axis)
      {
        const double each = std::max(1., std::ceil(std::pow(all / enough, 1. / dim)));
        stride[axis]      = std::min<double>(each, domain.cells[axis]);
        index[axis]       = stride[axis] / 2;
      }
    double       seen = 0, wet = 0, lowest = 0, highest = 0;
    Sample       result;
    const double strength = gravity.norm();
    const auto   first    = index;
    for (unsigned int axis = 0; axis < dim;)
      {
        dealii::Point<dim> place;
        for (unsigned int d = 0; d < dim; ++d)
          place[d] = domain.lower[d] + (index[d] + 0.5) * domain.spacing;
        seen += 1;
        if (region.value(place, 0.) > 0 &&
            (shapes.empty() || is_in_one(distances, place, domain.spacing)))
          {
            const double height = strength > 0 ? -(place * gravity) / strength : 0;
            lowest              = wet > 0 ? std::min(lowest, height) : height;
            highest             = wet > 0 ? std::max(highest, height) : height;
            wet += 1;
            result.fastest = std::max(result.fastest, velocity.vector(place, 0.).norm());
          }
        for (axis = 0; axis < dim && (index[axis] += stride[axis]) >= int(domain.cells[axis]);
             ++axis)
          index[axis] = first[axis];
      }
    result.share = wet / seen;
    if (wet > 0 && strength > 0)
      result.depth =
        highest - lowest + *std::max_element(stride.begin(), stride.end()) * domain.spacing;
    return result;
  }


  template <int dim>
  double
  ParticleFluid<dim>::depth(const dealii::Tensor<1, dim> &gravity, const double spacing) const
  {
    const double strength = gravity.norm();
    if (strength == 0 || places.empty())
      return 0;
    double highest = -std::numeric_limits<double>::infinity(), lowest = -highest;
    for (const auto &place : places)
      {
        const double height = -(place * gravity) / strength;
        highest             = std::max(highest, height);
        lowest              = std::min(lowest, height);
      }
    return highest - lowest + spacing;
  }


  template struct ParticleFluid<2>;
  template struct ParticleFluid<3>;
} // namespace undine
