// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/boundary/boundary.h>

#include <algorithm>
#include <iterator>
#include <map>

namespace undine
{
  namespace
  {
    const std::map<std::string, BoundaryKind> &
    kinds()
    {
      static const std::map<std::string, BoundaryKind> names{
        {"slip wall", BoundaryKind::slip_wall},
        {"no-slip wall", BoundaryKind::no_slip_wall},
        {"moving wall", BoundaryKind::moving_wall},
        {"inflow", BoundaryKind::inflow},
        {"pressure", BoundaryKind::pressure},
        {"outflow", BoundaryKind::outflow},
        {"periodic", BoundaryKind::periodic}};
      return names;
    }


    std::vector<std::string>
    kind_names()
    {
      std::vector<std::string> names;
      for (const auto &kind : kinds())
        names.push_back(kind.first);
      return names;
    }


    /// What a boundary of its kind does with a key.
    enum class Use
    {
      refused,
      optional,
      required
    };


    /// Throws InputError if the boundary gives a `key` that its kind refuses, or lacks one that its
    /// kind requires.
    void
    check_use(const Options     &options,
              const std::string &key,
              const Use          use,
              const std::string &kind)
    {
      if (options.is_reference())
        return;
      if (use == Use::refused && options.given(key))
        throw options.error(key,
                            "is not used by a boundary of the kind '" + kind + "'",
                            "Remove it or choose another 'Kind'.");
      if (use == Use::required && !options.given(key))
        throw options.error(
          key, "must be given for a boundary of the kind '" + kind + "'", "Allowed: expressions.");
    }


    template <int dim>
    Boundary<dim>
    read_boundary(const Options &options, const std::string &name)
    {
      Boundary<dim> boundary;
      boundary.name = name;
      std::vector<std::string> sides;
      std::string              kind = "slip wall";
      options.require("Sides",
                      sides,
                      "",
                      Allowed::one_of({side_names().begin(), side_names().begin() + 2 * dim}),
                      "Sides of the domain: the lower and upper ends of x, y (and z).");
      options.require(
        "Kind",
        kind,
        "",
        Allowed::one_of(kind_names()),
        "What the fluid does here. slip wall: no flow through it, no friction. "
        "no-slip wall: sticks. moving wall: sticks to a wall that moves along itself. "
        "inflow: given velocity. pressure: given reduced pressure, in or out. outflow: "
        "leaves without traction, or under a given pressure; where it comes back it does so from "
        "rest outside, with less pressure, and brings in no energy. periodic: goes on at the "
        "opposite side.");
      options.add("Region",
                  boundary.region,
                  "",
                  Allowed::constant_in_time(),
                  "Only the faces whose centre gives a value > 0; by default all of the sides. "
                  "Where boundaries overlap, the later one counts.");
      options.add(
        "Velocity",
        boundary.velocity,
        "m/s",
        Allowed::anything(),
        "Of inflow and moving wall, which need it; of the latter the part along the wall.");
      options.add(
        "Pressure",
        boundary.pressure,
        "Pa",
        Allowed::anything(),
        "Reduced pressure p - rho g.x of the kind 'pressure', which needs it; of the kind "
        "'outflow' that of the fluid at rest outside, 0 by default: with gravity the pressure p is "
        "then rho g.x there, which pulls at what is compressible and at what stands on walls. Of "
        "an open surface under air at the height H above the origin it is rho |g| H. Bodies that "
        "reach out there have it around them.");
      boundary.has_region = options.given("Region");
      boundary.kind       = kinds().at(kind);
      for (const auto &side : sides)
        boundary.sides.push_back(side_by_name(side));
      const bool has_velocity =
        boundary.kind == BoundaryKind::inflow || boundary.kind == BoundaryKind::moving_wall;
      const bool is_periodic = boundary.kind == BoundaryKind::periodic;
      check_use(options, "Velocity", has_velocity ? Use::required : Use::refused, kind);
      check_use(options,
                "Pressure",
                boundary.kind == BoundaryKind::pressure  ? Use::required
                : boundary.kind == BoundaryKind::outflow ? Use::optional
                                                         : Use::refused,
                kind);
      check_use(options, "Region", is_periodic ? Use::refused : Use::optional, kind);
      return boundary;
    }


    /// Both ends of a periodic axis must be periodic, and nothing else.
    template <int dim>
    void
    check_periodicity(const Options &options, const std::vector<Boundary<dim>> &boundaries)
    {
      std::vector<bool> is_periodic(2 * dim, false);
      for (const auto &boundary : boundaries)
        for (const auto &side : boundary.sides)
          if (boundary.kind == BoundaryKind::periodic)
            is_periodic[side.number()] = true;
      for (const auto &boundary : boundaries)
        for (const auto &side : boundary.sides)
          {
            const Side opposite{side.axis, 1 - side.end};
            if (is_periodic[side.number()] && boundary.kind != BoundaryKind::periodic)
              throw options.section(boundary.name)
                .error("Sides",
                       "'" + side_names()[side.number()] + "' is periodic by another section",
                       "Give the side one kind only.");
            if (is_periodic[side.number()] && !is_periodic[opposite.number()])
              throw options.section(boundary.name)
                .error("Kind",
                       "the side '" + side_names()[side.number()] +
                         "' is periodic but its opposite '" + side_names()[opposite.number()] +
                         "' is not",
                       "Make both of them periodic.");
          }
    }
  } // namespace


  const std::vector<std::string> &
  side_names()
  {
    static const std::vector<std::string> names{"left", "right", "bottom", "top", "back", "front"};
    return names;
  }


  Side
  side_by_name(const std::string &name)
  {
    const auto &names = side_names();
    const auto  found = std::find(names.begin(), names.end(), name) - names.begin();
    return {static_cast<unsigned int>(found / 2), static_cast<unsigned int>(found % 2)};
  }


  template <int dim>
  bool
  Boundary<dim>::prescribes_normal_velocity() const
  {
    return !is_open() && kind != BoundaryKind::periodic;
  }


  template <int dim>
  bool
  Boundary<dim>::prescribes_tangential_velocity() const
  {
    return has_friction() || kind == BoundaryKind::inflow;
  }


  template <int dim>
  bool
  Boundary<dim>::is_open() const
  {
    return kind == BoundaryKind::pressure || kind == BoundaryKind::outflow;
  }


  template <int dim>
  bool
  Boundary<dim>::lets_fluid_pass() const
  {
    return is_open() || kind == BoundaryKind::inflow;
  }


  template <int dim>
  bool
  Boundary<dim>::has_friction() const
  {
    return kind == BoundaryKind::no_slip_wall || kind == BoundaryKind::moving_wall;
  }


  template <int dim>
  double
  Boundary<dim>::velocity_along(const unsigned int        axis,
                                const unsigned int        normal_axis,
                                const dealii::Point<dim> &place,
                                const double              time) const
  {
    const bool given =
      kind == BoundaryKind::inflow || (kind == BoundaryKind::moving_wall && axis != normal_axis);
    return given && !velocity.is_zero() ? velocity.value(place, time, axis) : 0.;
  }


  template <int dim>
  std::vector<Boundary<dim>>
  read_boundaries(const Options &options)
  {
    std::vector<Boundary<dim>> boundaries;
    for (const auto &name : options.named_sections("boundary"))
      options.section(name).attempt(
        [&] { boundaries.push_back(read_boundary<dim>(options.section(name), name)); });
    check_periodicity(options, boundaries);
    return boundaries;
  }


  template <int dim>
  std::array<bool, dim>
  periodic_axes(const std::vector<Boundary<dim>> &boundaries)
  {
    std::array<bool, dim> periodic;
    periodic.fill(false);
    for (const auto &boundary : boundaries)
      if (boundary.kind == BoundaryKind::periodic)
        for (const auto &side : boundary.sides)
          periodic[side.axis] = true;
    return periodic;
  }


  template struct Boundary<2>;
  template struct Boundary<3>;
  template std::vector<Boundary<2>>
  read_boundaries(const Options &);
  template std::vector<Boundary<3>>
  read_boundaries(const Options &);
  template std::array<bool, 2>
  periodic_axes<2>(const std::vector<Boundary<2>> &);
  template std::array<bool, 3>
  periodic_axes<3>(const std::vector<Boundary<3>> &);
} // namespace undine
