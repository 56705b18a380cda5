// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/options/similar_words.h>
#include <undine/effects/effect.h>

#include <algorithm>

namespace undine
{
  template <int dim>
  void
  Effect<dim>::adapt_to(const std::vector<std::string> &)
  {
  }


  template <int dim>
  void
  Effect<dim>::check(const Options &, const Surroundings &) const
  {
  }


  template <int dim>
  std::string
  Effect<dim>::summary_of_particles() const
  {
    return summary();
  }


  template <int dim>
  std::vector<std::string>
  Effect<dim>::scalars() const
  {
    return {};
  }


  template <int dim>
  std::vector<typename Effect<dim>::CarriedScalar>
  Effect<dim>::carried_scalars() const
  {
    return {};
  }


  template <int dim>
  void
  Effect<dim>::initialize(const FluidModel<dim> &, FluidState<dim> &) const
  {
  }


  template <int dim>
  void
  Effect<dim>::transport(FluidStage<dim> &) const
  {
  }


  template <int dim>
  void
  Effect<dim>::accelerate(FluidStage<dim> &) const
  {
  }


  template <int dim>
  void
  Effect<dim>::diffuse(FluidStage<dim> &) const
  {
  }


  template <int dim>
  typename Effect<dim>::Work
  Effect<dim>::work() const
  {
    return {};
  }


  template <int dim>
  std::size_t
  Effect<dim>::memory_consumption(const FluidState<dim> &) const
  {
    return 0;
  }


  template <int dim>
  bool
  Effect<dim>::needs_no_slip_surfaces() const
  {
    return false;
  }


  template <int dim>
  void
  Effect<dim>::affect(SolidEnvironment<dim> &) const
  {
  }


  template <int dim>
  bool
  Effect<dim>::affect_particles(particles::Setup<dim> &) const
  {
    return false;
  }


  template <int dim>
  bool
  Effect<dim>::is_in_passes() const
  {
    return true;
  }


  template <int dim>
  std::pair<std::string, std::string>
  Effect<dim>::reason_not_for_particles() const
  {
    return {"this effect is one of fluids on a grid or of bodies of finite elements",
            "Remove the section: particles know 'gravity', 'viscosity', 'wall friction', "
            "'central attraction' and 'damping', and always carry their momentum."};
  }


  template <int dim>
  Columns
  Effect<dim>::columns(const FluidModel<dim> &, const FluidState<dim> &, double) const
  {
    return {};
  }


  template <int dim>
  double
  Effect<dim>::power_of_sides(const FluidModel<dim> &, const FluidState<dim> &, double) const
  {
    return 0;
  }


  template <int dim>
  void
  Effect<dim>::measure(Scales &, const FluidState<dim> &) const
  {
  }


  template <int dim>
  Effects<dim>
  read_effects(const Options &section)
  {
    const auto &registry = Registry<Effect<dim>>::instance();
    auto names = section.is_reference() ? registry.names() : section.named_sections("effect");
    std::sort(names.begin(), names.end());
    Effects<dim> effects;
    for (const auto &name : names)
      {
        if (!registry.contains(name))
          {
            const auto guess = did_you_mean(registry.names(), name);
            section.mistake(
              section.error(name,
                            "there is no such effect" + (guess.empty() ? "" : ". " + guess),
                            "Allowed: " + registry.joined_names()));
            section.leave_unjudged(name);
            continue;
          }
        effects.push_back(registry.make(name));
        effects.back()->name = name;
        section.section(name).attempt([&] { effects.back()->add_options(section.section(name)); });
      }
    for (const auto &effect : effects)
      effect->adapt_to(names);
    return effects;
  }


  template Effects<2>
  read_effects(const Options &);
  template Effects<3>
  read_effects(const Options &);
  template class Effect<2>;
  template class Effect<3>;
} // namespace undine
