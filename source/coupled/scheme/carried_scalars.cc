// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/core/errors.h>
#include <undine/coupled/scheme/carried_scalars.h>
#include <undine/particle_model/plain_vector.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace undine
{
  namespace
  {
    constexpr double most_of_layers = 0.9; // that may come in during a frame


    template <int dim>
    bool
    is_fluid(const particles::ParticleState<dim> &state, const std::size_t k)
    {
      return state.tags[k].kind() == particles::Kind::fluid;
    }


    /// One more than the largest identity.
    template <int dim>
    std::size_t
    count_identities(const particles::ParticleState<dim> &state)
    {
      const auto &all = state.identities;
      return all.empty() ? 0 : *std::max_element(all.begin(), all.end()) + 1;
    }


    template <int dim>
    std::string
    no_number(const std::string &field, const std::string &key, const dealii::Point<dim> &place)
    {
      return fmt::format("Effects / scalar transport / {}: '{}' is not a number at ({}). Try: an "
                         "expression that is finite wherever fluid is.",
                         field,
                         key,
                         fmt::join(place.begin_raw(), place.end_raw(), ", "));
    }
  } // namespace


  template <int dim>
  CarriedScalars<dim>::CarriedScalars(const Effects<dim> &effects, const ParticleModel<dim> &model)
    : model(model)
  {
    for (const auto &effect : effects)
      for (auto &field : effect->carried_scalars())
        {
          fields.push_back(std::move(field));
          phase = effect->name;
        }
  }


  template <int dim>
  double
  CarriedScalars<dim>::longest_frame() const
  {
    double depth = std::numeric_limits<double>::infinity(), fastest = 0;
    if (empty())
      return depth;
    for (const auto &side : model.setup().open_sides)
      if (side.is_inflow)
        depth = std::min(depth, side.depth);
    const auto &state = model.initial_state();
    for (std::size_t k = 0; k < state.tags.size(); ++k)
      if (state.tags[k].material() == particles::inflow_material)
        fastest = std::max(fastest, std::sqrt(norm_square(state.velocities[k])));
    return fastest > 0 ? most_of_layers * depth / fastest : depth;
  }


  template <int dim>
  void
  CarriedScalars<dim>::start(particles::ParticleState<dim> &state) const
  {
    for (const auto &field : fields)
      {
        auto &values = state.scalars[field.name];
        values.assign(count_identities(state), 0.);
        for (std::size_t k = 0; k < state.tags.size(); ++k)
          if (is_fluid(state, k))
            {
              const auto   place = point_of(state.positions[k]);
              const double value = field.initial(place);
              if (!std::isfinite(value))
                throw InputError(no_number(field.name, "Initial value", place));
              values[state.identities[k]] = value;
            }
      }
  }


  template <int dim>
  bool
  CarriedScalars<dim>::find_entry(Entry                                &entry,
                                  const particles::Vector<dim, double> &place,
                                  const particles::Vector<dim, double> &velocity,
                                  const double                          time,
                                  const double                          length) const
  {
    for (const auto &side : model.setup().open_sides)
      {
        const double speed = side.inward * velocity[side.axis];
        if (!side.is_inflow || !(speed > 0))
          continue; // layers move along the normal of their side
        const double behind    = side.inward * (side.plane - place[side.axis]);
        const double passed    = std::clamp(behind / speed, 0., length);
        entry.time             = time + passed;
        entry.place            = point_of(place);
        entry.place[side.axis] = side.plane;
        return true;
      }
    return false;
  }


  template <int dim>
  void
  CarriedScalars<dim>::follow(particles::ParticleState<dim>       &after,
                              const particles::ParticleState<dim> &before,
                              const double                         time,
                              const double                         length,
                              TimingTree                          &timing) const
  {
    if (empty())
      return;
    const auto               timed   = timing.section(phase);
    constexpr std::size_t    nowhere = -1;
    std::vector<std::size_t> numbers(std::max(count_identities(before), count_identities(after)),
                                     nowhere); // in `before`
    for (std::size_t k = 0; k < before.identities.size(); ++k)
      numbers[before.identities[k]] = k;
    for (const auto &field : fields)
      {
        const auto         &old = before.scalars.at(field.name);
        std::vector<double> values(count_identities(after), 0.);
        for (std::size_t k = 0; k < after.tags.size(); ++k)
          {
            if (!is_fluid(after, k))
              continue;
            const int         identity = after.identities[k];
            const std::size_t earlier  = numbers[identity];
            const auto        place    = point_of(after.positions[k]);
            Entry             from{place, time + length};
            double           &value    = values[identity];
            const bool        has_been = earlier != nowhere && is_fluid(before, earlier);
            if (has_been)
              {
                from  = {point_of(before.positions[earlier]), time};
                value = old[identity];
              }
            else
              {
                if (earlier != nowhere)
                  find_entry(
                    from, before.positions[earlier], before.velocities[earlier], time, length);
                value = field.entering(from.place, from.time);
              }
            if (field.source)
              value += (time + length - from.time) / 2 *
                       (field.source(from.place, from.time) + field.source(place, time + length));
            if (!std::isfinite(value))
              throw SolveError(
                no_number(field.name, has_been ? "Source" : "Inflow value", from.place));
          }
        after.scalars[field.name] = std::move(values);
      }
  }


  template <int dim>
  Columns
  CarriedScalars<dim>::columns(const particles::ParticleState<dim> &state) const
  {
    Columns result;
    for (const auto &field : fields)
      {
        const auto &values = state.scalars.at(field.name);
        double      sum    = 0;
        for (std::size_t k = 0; k < state.tags.size(); ++k)
          if (is_fluid(state, k))
            sum += values[state.identities[k]];
        result.push_back({"Integral of " + field.name,
                          "m^" + std::to_string(dim),
                          sum * std::pow(model.setup().spacing, dim)});
      }
    return result;
  }


  template class CarriedScalars<2>;
  template class CarriedScalars<3>;
} // namespace undine
