// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/solid/mesh/body_boundary.h>

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


    /// What a boundary of its kind does with a key.
    enum class Use
    {
      refused,
      optional,
      required
    };


    template <int dim>
    std::array<bool, dim>
    read_directions(const Options &options, const Use use)
    {
      if (!options.is_reference() && options.given("Components") && use == Use::refused)
        throw options.error("Components",
                            "is not used by a boundary of this 'Kind'",
                            "Remove it, or choose the 'Kind' clamp or prescribed motion.");
      const std::vector<std::string> all{"x", "y", "z"};
      std::vector<std::string>       axes(all.begin(), all.begin() + dim);
      const auto                     allowed = Allowed::one_of(axes);
      options.add("Components",
                  axes,
                  "",
                  allowed,
                  "Directions in which a clamp or a prescribed motion holds the body; it slides "
                  "freely in the others.");
      if (axes.empty())
        throw options.error("Components",
                            "names no direction",
                            "Allowed: " + allowed.description +
                              "; all of them if the key is left out.");
      std::array<bool, dim> result;
      for (unsigned int axis = 0; axis < dim; ++axis)
        result[axis] = std::find(axes.begin(), axes.end(), all[axis]) != axes.end();
      return result;
    }


    /// Declare and read a key that boundaries of one kind require, and that all others refuse.
    template <class Value>
    void
    add_of_one_kind(const Options     &options,
                    const std::string &key,
                    Value             &variable,
                    const std::string &unit,
                    const Use          use,
                    const std::string &help)
    {
      if (!options.is_reference())
        {
          if (use == Use::required && !options.given(key))
            throw options.error(key,
                                "must be given for a boundary of this 'Kind'",
                                "Allowed: expressions [" + unit + "]. " + help);
          if (use == Use::refused && options.given(key))
            throw options.error(key,
                                "is not used by a boundary of this 'Kind'",
                                "Remove it or choose another 'Kind'.");
        }
      options.add(key, variable, unit, Allowed::anything(), help);
    }
  } // namespace


  template <int dim>
  BodyBoundary<dim>::BodyBoundary(const std::string &name, const Options &options)
    : name(name)
    , options(options)
    , where("1")
    , kind(read_kind<dim>(options))
    , directions(read_directions<dim>(options, fixes_displacement() ? Use::optional : Use::refused))
  {
    const auto use_by = [this](const Kind user) {
      return kind == user ? Use::required : Use::refused;
    };
    options.add("Sides",
                sides,
                "",
                Allowed::anything(),
                "Names of the shape's sides (box: left, right, bottom, top, back, front); empty: "
                "the whole boundary.");
    options.add("Where",
                where,
                "1",
                Allowed::constant_in_time(),
                "Only faces at whose rest centre this is positive.");
    add_of_one_kind(options,
                    "Displacement",
                    motion,
                    "m",
                    use_by(Kind::prescribed_motion),
                    "Of the point that rests at x; needed by a prescribed motion, and only there.");
    add_of_one_kind(
      options,
      "Traction",
      traction,
      "Pa",
      use_by(Kind::traction),
      "Force per area at rest; keeps its direction and size when the body deforms. Needed "
      "by a traction, and only there.");
    add_of_one_kind(
      options,
      "Pressure",
      pressure,
      "Pa",
      use_by(Kind::pressure),
      "Pushes into the body along the deformed normal, per deformed area. Needed by a "
      "pressure, and only there.");
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
