// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/solid/mesh/solid_model.h>

#include <catch2/catch.hpp>
#include <effects/flow_run.h>

using namespace undine_tests;

namespace
{
  const std::string body =
    section("Bodies",
            section("block",
                    "set Shape = box\nset Lower corner = 0, 0\nset Upper corner = 1, 1\n"
                    "set Cells = 1, 1\nset Density = 1\nset Material = linear elastic\n"
                    "set Young's modulus = 1\nset Poisson's ratio = 0.3"));


  /// What a scene is made of.
  enum class Made
  {
    of_fluid,
    of_bodies,
    of_both
  };


  /// What check() of the effect `name` says when the scene's effects are `text`.
  std::string
  complaint(const std::string &name, const std::string &text, const Made scene)
  {
    const auto options =
      read_scene_text(std::string(FluidText{"4, 4"}) + body + section("Effects", text));
    return message_of([&] {
      const auto              effects = make_effects<2>(options);
      const FluidModel<2>     fluid(options, MPI_COMM_WORLD);
      const SolidModel<2>     solid(options, MPI_COMM_WORLD);
      constexpr bool          has_immersed_surfaces = false;
      Effect<2>::Surroundings around{scene == Made::of_bodies ? nullptr : &fluid,
                                     scene == Made::of_fluid ? nullptr : &solid,
                                     has_immersed_surfaces,
                                     {},
                                     {}};
      const Effect<2> *asked = nullptr;
      auto             names = options.section("Effects").named_sections("effect");
      std::sort(names.begin(), names.end());
      for (unsigned int e = 0; e < effects.size(); ++e)
        {
          around.effects.push_back(names[e]);
          for (const auto &scalar : effects[e]->scalars())
            around.scalars.push_back(scalar);
          if (names[e] == name)
            asked = effects[e].get();
        }
      asked->check(options.section("Effects").section(name), around);
    });
  }


  void
  check_contains(const std::string &text, const std::string &first, const std::string &second)
  {
    CHECK_THAT(text, Catch::Matchers::Contains(first));
    CHECK_THAT(text, Catch::Matchers::Contains(second));
  }


  const std::string smoke   = section("scalar transport", section("smoke", ""));
  const std::string gravity = section("gravity", "set Acceleration = 0, -9.81");
  const std::string lift = section("buoyancy", section("smoke", "set Expansion coefficient = 1"));
} // namespace


TEST_CASE("effects that contradict the scene are refused with a hint", "[effects]")
{
  check_contains(complaint("buoyancy", gravity + lift, Made::of_fluid),
                 "no field named 'smoke'",
                 "Effects/scalar transport");
  check_contains(
    complaint("buoyancy", smoke + lift, Made::of_fluid), "needs gravity", "subsection 'gravity'");
  check_contains(complaint("buoyancy", gravity + smoke + section("buoyancy", ""), Made::of_fluid),
                 "names no field",
                 "subsection");
  CHECK(complaint("buoyancy", gravity + smoke + lift, Made::of_fluid) == "no error");
  check_contains(complaint("viscosity", viscosity(1), Made::of_bodies), "none", "'Fluid'");
  check_contains(complaint("convection", convection(), Made::of_bodies), "none", "'Fluid'");
  check_contains(complaint("scalar transport", smoke, Made::of_bodies), "none", "'Fluid'");
  check_contains(complaint("scalar transport", section("scalar transport", ""), Made::of_fluid),
                 "no field to advect",
                 "subsection");
  check_contains(
    complaint("scalar transport",
              section("scalar transport", section("heat", "set Dirichlet boundaries = lid")),
              Made::of_fluid),
    "no boundary named 'lid'",
    "'other sides'");
  check_contains(complaint("scalar transport",
                           section("scalar transport", section("pressure", "")),
                           Made::of_fluid),
                 "another field",
                 "'smoke'");
  check_contains(
    complaint("damping", section("damping", "set Mass coefficient = 1"), Made::of_fluid),
    "bodies",
    "Remove");
  check_contains(complaint("damping", section("damping", ""), Made::of_both), "both zero", "> 0");
  CHECK(complaint("damping", section("damping", "set Mass coefficient = 1"), Made::of_both) ==
        "no error");
}


TEST_CASE("keys without a sensible default must be given", "[effects]")
{
  const auto why = [](const std::string &text) {
    return message_of([&] { make_effects<2>(read_scene_text(section("Effects", text))); });
  };
  check_contains(why(section("viscosity", "")), "'Dynamic viscosity'", "must be given");
  check_contains(why(section("viscosity", "set Dynamic viscosity = -1")), "> 0", "[Pa s]");
  check_contains(why(section("gravity", "")), "'Acceleration'", "must be given");
  check_contains(
    why(section("buoyancy", section("smoke", ""))), "'Expansion coefficient'", "must be given");
  check_contains(why(convection("upwind")), "MacCormack", "semi-Lagrangian");
  check_contains(why(section("scalar transport", section("heat", "set Dirichlet value = 1"))),
                 "no boundary",
                 "'Dirichlet boundaries'");
}


TEST_CASE("every registered effect documents itself and can be summarised", "[effects]")
{
  const auto options = Options::for_reference();
  for (const auto &name : Registry<Effect<3>>::instance().names())
    {
      const auto effect = Registry<Effect<3>>::instance().make(name);
      effect->add_options(options.section(name));
      CHECK_FALSE(Registry<Effect<3>>::instance().help(name).empty());
      CHECK_NOTHROW(effect->summary());
    }
  CHECK(options.entries().size() > 10);
  for (const auto &entry : options.entries())
    CHECK_FALSE(entry.help.empty());
}


TEST_CASE("gravity and damping reach the bodies' environment", "[effects]")
{
  const auto          effects = make_effects<2>(read_scene_text(section(
    "Effects",
    gravity + section("damping", "set Mass coefficient = 2\nset Stiffness coefficient = 3"))));
  SolidEnvironment<2> environment;
  for (const auto &effect : effects)
    effect->affect(environment);
  CHECK(environment.gravity[1] == -9.81);
  CHECK(environment.mass_damping == 2);
  CHECK(environment.stiffness_damping == 3);
}
