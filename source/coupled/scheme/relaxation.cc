// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/core/errors.h>
#include <undine/base/parallel/interruption.h>
#include <undine/coupled/scheme/relaxation.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace undine
{
  namespace
  {
    constexpr double explicit_steps = 8;               // in the shortest piece
    constexpr int    few_pieces = 8, many_pieces = 32; // until the kinetic energy passes a maximum
    constexpr double passed = 0.95; // of the largest kinetic energy: it was a maximum


    void
    add(particles::StepControl &sum, const particles::StepControl &piece)
    {
      const double smallest =
        sum.sub_steps == 0 ? piece.smallest_dt : std::min(sum.smallest_dt, piece.smallest_dt);
      const auto earlier = sum;
      sum                = piece;
      sum.smallest_dt    = smallest;
      sum.sub_steps += earlier.sub_steps;
      sum.elastic_steps_total += earlier.elastic_steps_total;
      sum.fastest = std::max(sum.fastest, earlier.fastest);
      for (int bound = 0; bound < static_cast<int>(particles::Bound::count); ++bound)
        sum.bounded_by[bound] += earlier.bounded_by[bound];
    }
  } // namespace


  template <int dim>
  Relaxation<dim>::Relaxation(particles::Engine<dim> &engine, const particles::Setup<dim> &setup)
    : engine(engine)
    , setup(setup)
  {
  }


  template <int dim>
  particles::StepControl
  Relaxation<dim>::relax(particles::ParticleState<dim> &state)
  {
    particles::StepControl sum;
    const double           shortest = explicit_steps * explicit_step();
    double                 piece    = shortest;
    stop(state);
    double rise = time_to_rise(state, engine.balance().elastic), since_stop = 0, most_kinetic = 0;
    int    pieces = 0; // since the last stop
    for (unsigned int k = 0; k < most_pieces; ++k)
      {
        if (interruption_requested()) // the engine looks less often than pieces end
          throw particles::FrameAbandoned("the motion to an equilibrium was abandoned.");
        add(sum, engine.advance(piece));
        since_stop += piece;
        ++pieces;
        const auto   balance = engine.balance();
        const double kinetic = balance.kinetic_solid;
        most_kinetic         = std::max(most_kinetic, kinetic);
        if (pieces % many_pieces == 0)
          piece *= 2;
        if (most_kinetic <= tolerance * balance.elastic)
          {
            if (since_stop < rise)
              continue;
            released_share = balance.elastic > 0 ? most_kinetic / balance.elastic : 0;
            engine.fetch(state);
            stop(state);
            return sum;
          }
        if (kinetic > passed * most_kinetic)
          continue;
        rise = std::max(rise, since_stop);
        if (pieces < few_pieces)
          piece = std::max(shortest, piece / 2);
        released_share = balance.elastic > 0 ? most_kinetic / balance.elastic : 0;
        engine.fetch(state);
        stop(state);
        ++n_stops;
        rise         = std::max(rise, time_to_rise(state, engine.balance().elastic));
        since_stop   = 0;
        most_kinetic = 0;
        pieces       = 0;
      }
    throw SolveError(fmt::format(
      "no equilibrium of the bodies was found in {} stops of their motion: they still release "
      "{:.2g} "
      "of their elastic energy, and may {:.2g}. Is every body held, and none about to buckle? Try "
      "smaller loads, several of 'Time / Step', or a dynamic run without 'Time / Integrator'.",
      n_stops,
      released_share,
      tolerance));
  }


  template <int dim>
  void
  Relaxation<dim>::stop(particles::ParticleState<dim> &state)
  {
    for (auto &velocity : state.velocities)
      velocity = particles::Vector<dim, double>::zero();
    engine.load(setup, state);
  }


  template <int dim>
  double
  Relaxation<dim>::time_to_rise(const particles::ParticleState<dim> &state,
                                const double                         elastic) const
  {
    if (!(elastic > 0))
      return 0;
    const double volume = std::pow(setup.spacing, dim);
    double       sum    = 0; // of m u^2
    for (std::size_t k = 0; k < state.tags.size(); ++k)
      if (state.tags[k].kind() == particles::Kind::solid)
        {
          const int  identity = state.identities[k];
          const auto moved    = displacement(state, k, setup.reference[identity]);
          sum += volume * setup.bodies[setup.body_of[identity]].density * norm_square(moved);
        }
    constexpr double quarter_turn = 1.5707963267948966;
    return quarter_turn * std::sqrt(sum / (2 * elastic));
  }


  template <int dim>
  double
  Relaxation<dim>::explicit_step() const
  {
    double shortest = 0;
    for (const auto &body : setup.bodies)
      {
        const double nu = body.poissons_ratio;
        const double modulus =
          body.youngs_modulus * (1 - nu) / ((1 + nu) * (1 - 2 * nu)); // lambda + 2 mu [Pa]
        const double step =
          setup.numerics.elastic_share * setup.spacing / std::sqrt(modulus / body.density);
        shortest = shortest > 0 ? std::min(shortest, step) : step;
      }
    return shortest;
  }


  template class Relaxation<2>;
  template class Relaxation<3>;
} // namespace undine
