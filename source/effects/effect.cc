// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/effects/effect.h>

namespace undine
{
  template <int dim>
  void
  Effect<dim>::check(const Options &, const Surroundings &) const
  {
  }


  template <int dim>
  std::vector<std::string>
  Effect<dim>::scalars() const
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
  Effect<dim>::transport(FluidStep<dim> &) const
  {
  }


  template <int dim>
  void
  Effect<dim>::accelerate(FluidStep<dim> &) const
  {
  }


  template <int dim>
  void
  Effect<dim>::diffuse(FluidStep<dim> &) const
  {
  }


  template <int dim>
  bool
  Effect<dim>::sticks_to_surfaces() const
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
  Columns
  Effect<dim>::columns(const FluidModel<dim> &, const FluidState<dim> &, double) const
  {
    return {};
  }


  template class Effect<2>;
  template class Effect<3>;
} // namespace undine
