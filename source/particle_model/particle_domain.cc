// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/boundary/boundary.h>
#include <undine/particle_model/particle_body.h>
#include <undine/particle_model/particle_domain.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace undine
{
  namespace
  {
    /// Cubes that the memory of no machine has room for.
    constexpr double most_cells = 5e8;


    std::vector<std::string>
    sides_of_dimension(const unsigned int dimension)
    {
      return {side_names().begin(), side_names().begin() + 2 * dimension};
    }
    /// Without digits that only rounding has brought.
    template <int dim>
    std::string
    short_text(const dealii::Point<dim> &point)
    {
      return fmt::format("{:.10g}", fmt::join(point.begin_raw(), point.begin_raw() + dim, ", "));
    }
  } // namespace


  template <int dim>
  ParticleDomain<dim>::ParticleDomain(const Options &scene,
                                      const double   spacing,
                                      const double   reach)
    : spacing(spacing)
    , layers(static_cast<unsigned int>(std::floor(reach)) + 1)
  {
    const auto domain = scene.section("Domain");
    cells.fill(1);
    sides.fill(ParticleSide::wall);
    if (!domain.given() && !scene.section("Fluid").given() && scene.section("Bodies").given())
      surround(read_particle_bodies<dim>(scene));
    else
      {
        read_corners(domain);
        read_sides(domain);
      }
  }


  template <int dim>
  void
  ParticleDomain<dim>::read_corners(const Options &domain)
  {
    for (unsigned int axis = 0; axis < dim; ++axis)
      upper[axis] = 1;
    domain.require("Lower corner",
                   lower,
                   "m",
                   Allowed::anything(),
                   "Lower end of the inside in each direction. A scene without a fluid may have no "
                   "section Domain: there is then room around the bodies, as far as the longest "
                   "edge of the box around all of them, and no wall.");
    domain.require(
      "Upper corner",
      upper,
      "m",
      Allowed::anything(),
      "Upper end of the inside in each direction; a whole number of spacings above the "
      "lower one.");
    if (domain.is_reference())
      return;
    double all = 1;
    auto   fit = upper;
    for (unsigned int axis = 0; axis < dim; ++axis)
      {
        if (!(upper[axis] > lower[axis]))
          throw domain.error("Upper corner",
                             std::string("is not above 'Lower corner' along ") + "xyz"[axis],
                             "Allowed: larger numbers in every direction.");
        const double count = std::max(1., std::round((upper[axis] - lower[axis]) / spacing));
        fit[axis]          = lower[axis] + count * spacing;
        all *= count;
        if (all < most_cells)
          cells[axis] = count;
      }
    if (all >= most_cells)
      throw domain.error(
        "Upper corner",
        fmt::format("with this 'Particles / Spacing' makes {:.3g} cubes for "
                    "particles",
                    all),
        fmt::format("Try: a larger spacing; at most {:.0e} cubes are possible.", most_cells));
    for (unsigned int axis = 0; axis < dim; ++axis)
      if (std::abs(fit[axis] - upper[axis]) > 1e-6 * spacing)
        throw domain.error(
          "Upper corner",
          fmt::format("is {:.6g} spacings above the lower one along {}: not a whole number",
                      (upper[axis] - lower[axis]) / spacing,
                      "xyz"[axis]),
          "Try: 'Upper corner = " + short_text(fit) +
            "', or a 'Particles / Spacing' that divides "
            "the domain.");
  }


  template <int dim>
  void
  ParticleDomain<dim>::surround(const std::vector<ParticleBody<dim>> &bodies)
  {
    sides.fill(ParticleSide::open);
    double edge = std::numeric_limits<double>::infinity();
    for (unsigned int axis = 0; axis < dim; ++axis)
      {
        lower[axis] = edge;
        upper[axis] = -edge;
      }
    for (const auto &body : bodies)
      for (const auto &node : make_shape_boundary(body.description).nodes)
        for (unsigned int axis = 0; axis < dim; ++axis)
          {
            lower[axis] = std::min(lower[axis], node[axis]);
            upper[axis] = std::max(upper[axis], node[axis]);
          }
    edge = 0;
    for (unsigned int axis = 0; axis < dim; ++axis)
      edge = std::max(edge, upper[axis] - lower[axis]);
    const double margin = std::ceil(edge / spacing) * spacing;
    for (unsigned int axis = 0; axis < dim; ++axis)
      {
        lower[axis] -= margin;
        const double count = std::ceil((upper[axis] + margin - lower[axis]) / spacing);
        if (!(count < most_cells))
          throw InputError(fmt::format("The bodies are {:.3g} m long, which is too many "
                                       "'Particles / Spacing' of {:.3g} m. Try: a larger spacing.",
                                       edge,
                                       spacing));
        cells[axis] = static_cast<unsigned int>(count);
        upper[axis] = lower[axis] + count * spacing;
      }
  }


  template <int dim>
  void
  ParticleDomain<dim>::read_sides(const Options &domain)
  {
    const auto               names = sides_of_dimension(dim);
    std::vector<std::string> open, periodic;
    domain.add("Open sides",
               open,
               "",
               Allowed::one_of(names),
               "Sides of the box without a wall. All others that are not periodic are walls.");
    domain.add("Periodic sides",
               periodic,
               "",
               Allowed::one_of(names),
               "Pairs of opposite sides: what leaves at one enters at the other.");
    for (unsigned int axis = 0; axis < dim; ++axis)
      room = std::max(room, upper[axis] - lower[axis]);
    domain.add(
      "Room beyond open sides",
      room,
      "m",
      Allowed::not_negative(),
      "How far particles may go. Fluid that goes farther is taken out and not computed any more; "
      "the run stops if a body goes farther. Not given: the longest edge of the box.");
    if (domain.is_reference())
      return;
    const auto mark =
      [&](const std::vector<std::string> &marked, const ParticleSide what, const std::string &key) {
        for (const auto &name : marked)
          {
            auto &side = sides[std::find(names.begin(), names.end(), name) - names.begin()];
            if (side != ParticleSide::wall && side != what)
              throw domain.error(
                key, "names '" + name + "', which is open as well", "Give each side one kind.");
            side = what;
          }
      };
    mark(open, ParticleSide::open, "Open sides");
    mark(periodic, ParticleSide::periodic, "Periodic sides");
    for (unsigned int side = 0; side < 2 * dim; ++side)
      if (sides[side] == ParticleSide::periodic && sides[side ^ 1] != ParticleSide::periodic)
        throw domain.error("Periodic sides",
                           "names '" + names[side] + "' but not its opposite '" + names[side ^ 1] +
                             "'",
                           "Make both of them periodic.");
  }


  template <int dim>
  bool
  ParticleDomain<dim>::contains(const dealii::Point<dim> &place) const
  {
    for (unsigned int axis = 0; axis < dim; ++axis)
      if (!(place[axis] > lower[axis] && place[axis] < upper[axis]))
        return false;
    return true;
  }


  template <int dim>
  double
  ParticleDomain<dim>::distance_outside(const dealii::Point<dim> &place) const
  {
    double result = -std::numeric_limits<double>::infinity();
    for (unsigned int axis = 0; axis < dim; ++axis)
      {
        const double below = sides[2 * axis] == ParticleSide::open ? room : 0;
        const double above = sides[2 * axis + 1] == ParticleSide::open ? room : 0;
        result =
          std::max({result, lower[axis] - below - place[axis], place[axis] - upper[axis] - above});
      }
    return result;
  }


  template <int dim>
  dealii::Tensor<1, dim>
  ParticleDomain<dim>::way(const dealii::Point<dim> &to, const dealii::Point<dim> &from) const
  {
    dealii::Tensor<1, dim> result = to - from;
    for (unsigned int axis = 0; axis < dim; ++axis)
      if (periodic(axis))
        {
          const double period = upper[axis] - lower[axis];
          result[axis] -= period * std::round(result[axis] / period);
        }
    return result;
  }


  template <int dim>
  dealii::Point<dim>
  ParticleDomain<dim>::outermost_lower() const
  {
    auto result = lower;
    for (unsigned int axis = 0; axis < dim; ++axis)
      if (sides[2 * axis] != ParticleSide::periodic)
        result[axis] -=
          (layers + 2) * spacing + (sides[2 * axis] == ParticleSide::open ? room : 0.);
    return result;
  }


  template <int dim>
  dealii::Point<dim>
  ParticleDomain<dim>::outermost_upper() const
  {
    auto result = upper;
    for (unsigned int axis = 0; axis < dim; ++axis)
      if (sides[2 * axis + 1] != ParticleSide::periodic)
        result[axis] +=
          (layers + 2) * spacing + (sides[2 * axis + 1] == ParticleSide::open ? room : 0.);
    return result;
  }


  template <int dim>
  std::vector<WallParticle<dim>>
  ParticleDomain<dim>::wall_particles() const
  {
    std::array<int, dim> begin, end;
    for (unsigned int axis = 0; axis < dim; ++axis)
      {
        begin[axis] = sides[2 * axis] == ParticleSide::wall ? -int(layers) : 0;
        end[axis]   = cells[axis] + (sides[2 * axis + 1] == ParticleSide::wall ? layers : 0);
      }
    std::vector<WallParticle<dim>> result;
    for_each_centre(begin, end, [&](const dealii::Point<dim> &centre, const auto &index) {
      int depth = 0; // in layers; 0: inside
      for (unsigned int axis = 0; axis < dim; ++axis)
        depth = std::max({depth, -index[axis], index[axis] - int(cells[axis]) + 1});
      if (depth > 0)
        result.push_back({centre, static_cast<unsigned int>(depth - 1)});
    });
    return result;
  }


  template class ParticleDomain<2>;
  template class ParticleDomain<3>;
} // namespace undine
