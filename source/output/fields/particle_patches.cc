// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/output/fields/particle_patches.h>
#include <undine/particles/setup/make_constants.h>

namespace undine
{
  namespace
  {
    /// The numbers of one particle, in the order of the fields.
    template <int dim>
    dealii::DataOutBase::Patch<0, dim>
    patch_of(const std::size_t                    k,
             const ParticleModel<dim>            &model,
             const particles::ParticleState<dim> &state)
    {
      const auto                         tag      = state.tags[k];
      const int                          identity = state.identities[k];
      const auto                        &rest     = model.setup().reference;
      dealii::DataOutBase::Patch<0, dim> patch;
      patch.data.reinit(2 * dim + 4 + state.scalars.size(), 1);
      unsigned int row = 0;
      for (unsigned int axis = 0; axis < dim; ++axis)
        {
          patch.vertices[0][axis] = state.positions[k][axis];
          patch.data(row++, 0)    = state.velocities[k][axis];
        }
      auto moved = particles::Vector<dim, double>::zero();
      if (tag.kind() == particles::Kind::solid)
        moved = particles::displacement(state, k, rest[identity]);
      for (unsigned int axis = 0; axis < dim; ++axis)
        patch.data(row++, 0) = moved[axis];
      patch.data(row++, 0) =
        state.pressures[k] + pressure_at_rest(model.setup(), state.positions[k]);
      patch.data(row++, 0) = static_cast<int>(tag.kind());
      patch.data(row++, 0) = tag.kind() == particles::Kind::solid ? tag.material() - 1 : -1;
      patch.data(row++, 0) = identity;
      for (const auto &[name, values] : state.scalars)
        patch.data(row++, 0) = tag.kind() == particles::Kind::fluid ? values[identity] : 0;
      return patch;
    }
  } // namespace


  template <int dim>
  Patches<0, dim>
  particle_patches(const ParticleModel<dim> &model, const particles::ParticleState<dim> &state)
  {
    Patches<0, dim> result;
    result.name = "particles";
    result.add_vector("velocity", "m/s");
    result.add_vector("displacement", "m");
    result.add_scalar("pressure", "Pa");
    result.add_scalar("kind", "1");
    result.add_scalar("body", "1");
    result.add_scalar("identity", "1");
    for (const auto &[name, values] : state.scalars)
      result.add_scalar(name, "");
    for (std::size_t k = 0; k < state.positions.size(); ++k)
      {
        const auto kind = state.tags[k].kind();
        if (model.shows_walls() || kind == particles::Kind::fluid || kind == particles::Kind::solid)
          {
            result.patches.push_back(patch_of(k, model, state));
            result.patches.back().patch_index = result.patches.size() - 1;
          }
      }
    return result;
  }


  template Patches<0, 2>
  particle_patches(const ParticleModel<2> &, const particles::ParticleState<2> &);
  template Patches<0, 3>
  particle_patches(const ParticleModel<3> &, const particles::ParticleState<3> &);
} // namespace undine
