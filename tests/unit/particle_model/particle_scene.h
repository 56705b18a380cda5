// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_tests_particle_model_particle_scene_h
#define undine_tests_particle_model_particle_scene_h

#include <undine/particle_model/particle_model.h>

#include <effects/flow_run.h>

#include <algorithm>
#include <string>

namespace undine_tests
{
  /// A box of `cells` unit cubes along each axis as particles' domain.
  template <int dim>
  std::string
  particle_box(const unsigned int cells, const std::string &keys = "")
  {
    std::string lower = "0", upper = std::to_string(cells);
    for (unsigned int axis = 1; axis < dim; ++axis)
      {
        lower += ", 0";
        upper += ", " + std::to_string(cells);
      }
    return section("Particles", "set Spacing = 1") +
           section("Domain",
                   "set Lower corner = " + lower + "\n set Upper corner = " + upper + "\n" + keys);
  }


  template <int dim>
  ParticleModel<dim>
  read_particles(const std::string &text)
  {
    const auto         options = read_scene_text(text);
    const auto         effects = make_effects<dim>(options);
    ParticleModel<dim> model(options, effects, MPI_COMM_SELF);
    options.assert_all_used();
    return model;
  }


  template <int dim>
  std::size_t
  count(const ParticleModel<dim> &model, const particles::Kind kind)
  {
    const auto &tags = model.initial_state().tags;
    return std::count_if(
      tags.begin(), tags.end(), [&](const auto tag) { return tag.kind() == kind; });
  }
} // namespace undine_tests

#endif
