// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/particle_model/particle_openings.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace undine
{
  namespace
  {
    constexpr double rounding = 1e-6; // of the speed, or [spacings]


    /// Where the side is along its axis [m].
    template <int dim>
    double
    plane_of(const Side &side, const ParticleDomain<dim> &domain)
    {
      return side.end == 0 ? domain.lower[side.axis] : domain.upper[side.axis];
    }


    /// Is a wall's particle straight behind a side, not around the corner?
    template <int dim>
    bool
    is_behind(const dealii::Point<dim> &place, const Side &side, const ParticleDomain<dim> &domain)
    {
      auto foot       = place;
      foot[side.axis] = (domain.lower[side.axis] + domain.upper[side.axis]) / 2;
      return domain.contains(foot) && (place[side.axis] - plane_of(side, domain)) * side.sign() > 0;
    }


    template <int dim>
    void
    check_sides(const ParticleOpening<dim> &opening, const ParticleDomain<dim> &domain)
    {
      for (const auto &side : opening.sides)
        {
          const auto kind = domain.sides[side.number()];
          if (kind != ParticleSide::wall)
            throw opening.options.error("Sides",
                                        "names '" + side_names()[side.number()] + "', which is " +
                                          (kind == ParticleSide::open ? "open" : "periodic") +
                                          " by the section 'Domain'",
                                        "Give the side one kind only.");
        }
    }


    /// Where a particle has crossed an inflow and become fluid, a parked one is put behind the
    /// nearest inflow: near the plane of another one that could be the wrong one.
    template <int dim>
    void
    check_edges(const ParticleOpening<dim>   &opening,
                const dealii::Point<dim>     &foot,
                const Side                   &side,
                const std::set<unsigned int> &inflows,
                const ParticleDomain<dim>    &domain)
    {
      for (const unsigned int number : inflows)
        {
          const Side other{number / 2, number % 2};
          if (other.axis != side.axis && std::abs(foot[other.axis] - plane_of(other, domain)) <
                                           domain.layers * domain.spacing / 2)
            throw opening.options.error(
              "Region",
              "reaches to the edge (" + write_value(foot) + ") where the inflow at '" +
                side_names()[number] + "' begins",
              "Try: leave " + write_value(domain.layers * domain.spacing / 2) +
                " m of wall between inflows of different sides.");
        }
    }


    /// Numbers of the sides with openings of a kind.
    template <int dim>
    std::set<unsigned int>
    sides_of(const std::vector<ParticleOpening<dim>> &openings, const OpeningKind kind)
    {
      std::set<unsigned int> result;
      for (const auto &opening : openings)
        for (const auto &side : opening.sides)
          if (opening.kind == kind)
            result.insert(side.number());
      return result;
    }


    /// That of a side which is no inflow; nullptr if there is none. All of a side have one plane,
    /// and so must be alike.
    template <int dim>
    const ParticleOpening<dim> *
    opening_of(const std::vector<ParticleOpening<dim>> &openings, const unsigned int number)
    {
      const ParticleOpening<dim> *result = nullptr;
      for (const auto &opening : openings)
        for (const auto &side : opening.sides)
          if (opening.kind != OpeningKind::inflow && side.number() == number)
            {
              if (result != nullptr &&
                  (result->kind != opening.kind || result->pressure != opening.pressure))
                throw opening.options.error(
                  "Kind",
                  "differs from that of another opening at the same side, "
                  "or the pressure does",
                  "Try: the same kind and pressure.");
              result = &opening;
            }
      return result;
    }


    template <int dim>
    bool
    is_beside_an_open_side(const Side &side, const ParticleDomain<dim> &domain)
    {
      if (domain.sides[side.number()] != ParticleSide::wall)
        return false;
      for (unsigned int number = 0; number < 2 * dim; ++number)
        if (number / 2 != side.axis && domain.sides[number] == ParticleSide::open)
          return true;
      return false;
    }


    template <int dim>
    void
    check_openings(const std::vector<ParticleOpening<dim>> &openings,
                   const std::vector<unsigned int>         &counts,
                   const std::vector<double>               &speeds)
    {
      for (unsigned int k = 0; k < openings.size(); ++k)
        {
          if (counts[k] == 0)
            throw openings[k].options.error(
              "Region",
              "leaves nothing of this boundary",
              "Try: an expression that is positive at centres of particles on the side, which "
              "begin half a spacing from its ends; where boundaries overlap, the later one "
              "counts.");
          if (openings[k].kind == OpeningKind::inflow && speeds[k] == 0)
            throw openings[k].options.error(
              "Velocity", "is zero: nothing flows in", "Try: a velocity into the domain.");
        }
    }
  } // namespace


  template <int dim>
  ParticleOpening<dim>::ParticleOpening(const Options &options)
    : options(options)
    , region("1")
  {
    std::vector<std::string> names;
    std::string              word = "outflow";
    options.require("Sides",
                    names,
                    "",
                    Allowed::one_of({side_names().begin(), side_names().begin() + 2 * dim}),
                    "Sides of the box: the lower and upper ends of x, y (and z).");
    options.require(
      "Kind",
      word,
      "",
      Allowed::one_of({"inflow", "outflow", "pressure"}),
      "What the fluid does here. inflow: enters with the given velocity. outflow: "
      "leaves, and is not computed any more; in a domain that is full it also comes back, "
      "from rest. pressure: leaves and enters under a given pressure; where the fluid has "
      "a surface the side is open, to air.");
    options.add("Region",
                region,
                "",
                Allowed::constant_in_time(),
                "Only where this is positive on the sides; by default all of them. The rest is a "
                "wall. Where boundaries overlap, the later one counts.");
    options.add("Velocity",
                velocity,
                "m/s",
                Allowed::constant_in_time(),
                "Of an inflow, normal to the side.");
    options.add("Pressure",
                pressure,
                "Pa",
                Allowed::anything(),
                "Of `Kind = pressure`; zero where the fluid has a surface.");
    kind                 = word == "inflow"    ? OpeningKind::inflow
                           : word == "outflow" ? OpeningKind::outflow
                                               : OpeningKind::pressure;
    const bool is_inflow = kind == OpeningKind::inflow;
    for (const auto &name : names)
      sides.push_back(side_by_name(name));
    if (options.is_reference())
      return;
    if (is_inflow && !options.given("Velocity"))
      throw options.error("Velocity", "must be given for an inflow", "Allowed: expressions [m/s].");
    if (!is_inflow && options.given("Velocity"))
      throw options.error("Velocity",
                          "is not used by an opening of this kind",
                          "Remove it: fluid leaves with the velocity it has.");
    if (kind != OpeningKind::pressure && options.given("Pressure"))
      throw options.error("Pressure",
                          "is not used by an opening of this kind",
                          "Try: 'Kind = pressure', or remove it.");
  }


  template <int dim>
  bool
  ParticleOpening<dim>::covers(const dealii::Point<dim> &place) const
  {
    const double value = region.value(place, 0.);
    if (!std::isfinite(value))
      throw options.error("Region",
                          "is not a number at (" + write_value(place) + ")",
                          "Try: an expression that is finite on the whole side.");
    return value > 0;
  }


  template <int dim>
  dealii::Tensor<1, dim>
  ParticleOpening<dim>::velocity_at(const dealii::Point<dim> &place, const Side &side) const
  {
    const auto   result = velocity.vector(place, 0.);
    const double inward = -side.sign() * result[side.axis];
    const auto   where  = " at (" + write_value(place) + ")";
    if (!std::isfinite(result.norm()))
      throw options.error("Velocity",
                          "is not a number" + where,
                          "Try: an expression that is finite on the whole side.");
    if (inward < 0)
      throw options.error("Velocity",
                          "points out of the domain" + where,
                          "Try: the opposite sign, or 'Kind = outflow', which has no velocity.");
    if (result.norm() > (1 + rounding) * inward)
      throw options.error("Velocity",
                          "is not normal to the side '" + side_names()[side.number()] + "'" + where,
                          "Try: zero along the side; particles flow in straight.");
    return result;
  }


  template <int dim>
  std::vector<ParticleOpening<dim>>
  read_particle_openings(const Options &fluid)
  {
    const auto                        section = fluid.section("Boundaries");
    std::vector<ParticleOpening<dim>> result;
    for (const auto &name : section.named_sections("boundary"))
      section.section(name).attempt([&] { result.emplace_back(section.section(name)); });
    return result;
  }


  template <int dim>
  std::vector<LayerParticle<dim>>
  open_walls(std::vector<WallParticle<dim>>          &walls,
             const std::vector<ParticleOpening<dim>> &openings,
             const ParticleDomain<dim>               &domain)
  {
    for (const auto &opening : openings)
      check_sides(opening, domain);
    const auto                      inflows = sides_of(openings, OpeningKind::inflow);
    std::vector<unsigned int>       counts(openings.size(), 0);
    std::vector<double>             speeds(openings.size(), 0.);
    std::vector<LayerParticle<dim>> result;
    std::vector<WallParticle<dim>>  closed;
    for (const auto &wall : walls)
      {
        int         last = -1;
        const Side *at   = nullptr;
        auto        foot = wall.place;
        for (unsigned int k = 0; k < openings.size(); ++k)
          for (const auto &side : openings[k].sides)
            if (is_behind(wall.place, side, domain))
              {
                foot[side.axis] = plane_of(side, domain);
                if (openings[k].covers(foot))
                  {
                    last = k;
                    at   = &side;
                  }
              }
        if (last < 0)
          {
            closed.push_back(wall);
            continue;
          }
        ++counts[last];
        const bool is_inflow = openings[last].kind == OpeningKind::inflow;
        result.push_back({wall.place, wall.layer, {}, is_inflow});
        if (!is_inflow)
          continue;
        check_edges(openings[last], foot, *at, inflows, domain);
        result.back().velocity = openings[last].velocity_at(foot, *at);
        speeds[last]           = std::max(speeds[last], result.back().velocity.norm());
      }
    check_openings(openings, counts, speeds);
    walls = std::move(closed);
    return result;
  }


  template <int dim>
  void
  open_to_air(std::vector<ParticleOpening<dim>> &openings, ParticleDomain<dim> &domain)
  {
    std::vector<ParticleOpening<dim>> result;
    for (auto &opening : openings)
      {
        if (opening.kind != OpeningKind::pressure)
          {
            result.push_back(std::move(opening));
            continue;
          }
        if (opening.pressure != 0)
          throw opening.options.error("Pressure",
                                      "is not zero, and the fluid has a surface",
                                      "Allowed: 0 beside a 'Region', 'Shapes' or 'Void regions' of "
                                      "the fluid; pressures are those beyond the air's.");
        check_sides(opening, domain);
        if (opening.options.given("Region"))
          throw opening.options.error(
            "Region", "opens a part of a side to air", "Try: whole sides, and obstacles on them.");
        for (const auto &side : opening.sides)
          domain.sides[side.number()] = ParticleSide::open;
      }
    openings = std::move(result);
  }


  template <int dim>
  std::vector<particles::OpenSide>
  open_sides(const std::vector<ParticleOpening<dim>> &openings,
             const ParticleDomain<dim>               &domain,
             const bool                               is_full)
  {
    std::vector<particles::OpenSide> result;
    const auto add = [&](const Side &side, const double plane) -> particles::OpenSide & {
      particles::OpenSide open;
      open.axis   = side.axis;
      open.plane  = plane;
      open.inward = -side.sign();
      result.push_back(open);
      return result.back();
    };
    const auto   inflows = sides_of(openings, OpeningKind::inflow);
    const double depth   = domain.layers * domain.spacing;
    for (unsigned int number = 0; number < 2 * dim; ++number)
      {
        const Side   side{number / 2, number % 2};
        const double plane = plane_of(side, domain);
        if (inflows.count(number) != 0)
          {
            auto &inflow     = add(side, plane);
            inflow.is_inflow = true;
            inflow.depth     = depth;
          }
        const auto *opening = opening_of(openings, number);
        if (opening != nullptr && is_full)
          {
            auto &open            = add(side, plane);
            open.is_opening       = true;
            open.depth            = depth;
            open.pressure         = opening->pressure;
            open.enters_from_rest = opening->kind == OpeningKind::outflow;
          }
        else if (opening != nullptr)
          add(side, plane);
        else if (domain.sides[number] == ParticleSide::open)
          add(side, plane + side.sign() * domain.room);
        else if (is_beside_an_open_side(side, domain)) // drops fly over the wall
          add(side, plane + side.sign() * depth);
      }
    return result;
  }


#define UNDINE_INSTANTIATE(dim)                                                                    \
  template struct ParticleOpening<dim>;                                                            \
  template std::vector<ParticleOpening<dim>> read_particle_openings(const Options &);              \
  template std::vector<LayerParticle<dim>>   open_walls(std::vector<WallParticle<dim>> &,          \
                                                        const std::vector<ParticleOpening<dim>> &, \
                                                        const ParticleDomain<dim> &);              \
  template std::vector<particles::OpenSide>  open_sides(                                           \
     const std::vector<ParticleOpening<dim>> &, const ParticleDomain<dim> &, bool);                \
  template void open_to_air(std::vector<ParticleOpening<dim>> &, ParticleDomain<dim> &);

  UNDINE_INSTANTIATE(2)
  UNDINE_INSTANTIATE(3)
#undef UNDINE_INSTANTIATE
} // namespace undine
