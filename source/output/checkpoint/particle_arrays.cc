// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/core/errors.h>
#include <undine/output/checkpoint/particle_arrays.h>

#include <algorithm>

namespace undine
{
  namespace
  {
    const std::string positions_name = "particles/positions", guesses_name = "particles/guesses",
                      spacing_name = "particles/spacing", points_name = "particles/body points";


    std::string
    name_of_scalar(const std::string &name)
    {
      return "particles/scalars/" + name;
    }


    StateArray
    array_of(const std::string &name, const std::vector<double> &values, const hsize_t columns)
    {
      const hsize_t rows = values.size() / columns;
      return {name, {{rows, columns}, {0, 0}, {rows, columns}}, values};
    }


    template <int dim>
    std::vector<double>
    components(const std::vector<particles::Vector<dim, double>> &vectors)
    {
      std::vector<double> result;
      for (const auto &vector : vectors)
        result.insert(result.end(), vector.entries, vector.entries + dim);
      return result;
    }


    template <int dim>
    void
    set_components(std::vector<particles::Vector<dim, double>> &vectors,
                   const std::vector<double>                   &values)
    {
      for (std::size_t k = 0; k < values.size(); ++k)
        vectors[k / dim][k % dim] = values[k];
    }
  } // namespace


  template <int dim>
  std::vector<StateArray>
  pack_particles(const particles::ParticleState<dim> &state, const double spacing)
  {
    std::vector<double> tags;
    for (const auto tag : state.tags)
      tags.push_back(tag.code);
    std::vector<StateArray> result{
      array_of(spacing_name, {spacing}, 1),
      array_of(positions_name, components(state.positions), dim),
      array_of("particles/velocities", components(state.velocities), dim),
      array_of("particles/pressures", state.pressures, 1),
      array_of("particles/tags", tags, 1),
      array_of("particles/identities",
               std::vector<double>(state.identities.begin(), state.identities.end()),
               1)};
    if (!state.guesses.empty())
      result.push_back(array_of(guesses_name, state.guesses, 1));
    if (!state.body_points.empty())
      result.push_back(array_of(points_name, components(state.body_points), dim));
    for (const auto &[name, values] : state.scalars)
      result.push_back(array_of(name_of_scalar(name), values, 1));
    return result;
  }


  template <int dim>
  void
  unpack_particles(particles::ParticleState<dim> &state, const std::vector<StateArray> &arrays)
  {
    auto array = arrays.begin() + 1; // the spacing is the scene's
    set_components(state.positions, (array++)->values);
    set_components(state.velocities, (array++)->values);
    state.pressures = (array++)->values;
    std::transform(array->values.begin(),
                   array->values.end(),
                   state.tags.begin(),
                   [](const double code) { return particles::Tag{static_cast<int>(code)}; });
    ++array;
    state.identities.assign(array->values.begin(), array->values.end());
    ++array;
    if (!state.guesses.empty())
      state.guesses = (array++)->values;
    if (!state.body_points.empty())
      set_components(state.body_points, (array++)->values);
    for (auto &[name, values] : state.scalars)
      values = (array++)->values;
  }


  template <int dim>
  void
  resize_particles(particles::ParticleState<dim> &state,
                   const double                   spacing,
                   const HDF5Reader              &file)
  {
    const auto length = [&file](const std::string &name) {
      return file.contains(name) ? file.size(name)[0] : 0;
    };
    if (length(spacing_name) == 0)
      throw FileError("the checkpoint has no particles: it belongs to another scene");
    const double saved = file.read<double>(spacing_name, {{1, 1}, {0, 0}, {1, 1}})[0];
    if (saved != spacing)
      throw FileError("the checkpoint's particles are " + std::to_string(saved) +
                      " m apart, which is not the scene's 'Particles / Spacing'");
    const auto n = length(positions_name);
    state.positions.resize(n);
    state.velocities.resize(n);
    state.pressures.resize(n);
    state.tags.resize(n);
    state.identities.resize(n);
    state.guesses.resize(length(guesses_name));
    state.body_points.resize(length(points_name)); // earlier versions do not write them
    for (auto &[name, values] : state.scalars)
      values.resize(length(name_of_scalar(name)));
  }


  template <int dim>
  std::size_t
  count_lasting_particles(const particles::ParticleState<dim> &state)
  {
    return std::count_if(state.tags.begin(), state.tags.end(), [](const particles::Tag tag) {
      return tag.kind() != particles::Kind::fluid && !tag.is_in_layers();
    });
  }


  template std::vector<StateArray>
  pack_particles(const particles::ParticleState<2> &, double);
  template std::vector<StateArray>
  pack_particles(const particles::ParticleState<3> &, double);
  template void
  unpack_particles(particles::ParticleState<2> &, const std::vector<StateArray> &);
  template void
  unpack_particles(particles::ParticleState<3> &, const std::vector<StateArray> &);
  template void
  resize_particles(particles::ParticleState<2> &, double, const HDF5Reader &);
  template void
  resize_particles(particles::ParticleState<3> &, double, const HDF5Reader &);
  template std::size_t
  count_lasting_particles(const particles::ParticleState<2> &);
  template std::size_t
  count_lasting_particles(const particles::ParticleState<3> &);
} // namespace undine
