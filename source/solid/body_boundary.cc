// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/solid/body_boundary.h>

#include <algorithm>
#include <map>

namespace undine
{
  namespace
  {
    template <int dim>
    using Kinds = std::map<std::string, typename BodyBoundary<dim>::Kind>;


    template <int dim>
    const Kinds<dim> &
    kinds()
    {
      using Kind = typename BodyBoundary<dim>::Kind;
      static const Kinds<dim> names{{"clamp", Kind::clamp},
                                    {"prescribed motion", Kind::prescribed_motion},
                                    {"traction", Kind::traction},
                                    {"pressure", Kind::pressure}};
      return names;
    }


    template <int dim>
    typename BodyBoundary<dim>::Kind
    read_kind(const Options &options)
    {
      std::vector<std::string> words;
      for (const auto &kind : kinds<dim>())
        words.push_back(kind.first);
      std::string kind = "clamp";
      options.add(
        "Kind",
        kind,
        "",
        Allowed::one_of(words),
        "clamp: held at the initial displacement; prescribed motion: follows Displacement; "
        "traction: dead load Traction; pressure: follower load Pressure.");
      return kinds<dim>().at(kind);
    }


    template <int dim>
    std::array<bool, dim>
    read_directions(const Options &options)
    {
      const std::vector<std::string> all{"x", "y", "z"};
      std::vector<std::string>       axes(all.begin(), all.begin() + dim);
      const auto                     allowed = Allowed::one_of(axes);
      options.add("Components",
                  axes,
                  "",
                  allowed,
                  "Directions in which a clamp or a prescribed motion holds the body; it slides "
                  "freely in the others.");
      std::array<bool, dim> result;
      for (unsigned int axis = 0; axis < dim; ++axis)
        result[axis] = std::find(axes.begin(), axes.end(), all[axis]) != axes.end();
      return result;
    }
  } // namespace


  template <int dim>
  BodyBoundary<dim>::BodyBoundary(const std::string &name, const Options &options)
    : name(name)
    , options(options)
    , where("1")
    , kind(read_kind<dim>(options))
    , directions(read_directions<dim>(options))
  {
    options.add("Sides",
                sides,
                "",
                Allowed::anything(),
                "Names of the shape's sides (box: left, right, bottom, top, back, front); empty: "
                "the whole boundary.");
    options.add("Where",
                where,
                "1",
                Allowed::anything(),
                "Only faces at whose rest centre this is positive.");
    options.add("Displacement",
                motion,
                "m",
                Allowed::anything(),
                "The prescribed motion of the point that rests at x.");
    options.add("Traction",
                traction,
                "Pa",
                Allowed::anything(),
                "Force per area at rest; keeps its direction and size when the body deforms.");
    options.add("Pressure",
                pressure,
                "Pa",
                Allowed::anything(),
                "Pushes into the body along the deformed normal, per deformed area.");
  }


  template <int dim>
  bool
  BodyBoundary<dim>::fixes_displacement() const
  {
    return kind == Kind::clamp || kind == Kind::prescribed_motion;
  }


  template struct BodyBoundary<2>;
  template struct BodyBoundary<3>;
} // namespace undine
