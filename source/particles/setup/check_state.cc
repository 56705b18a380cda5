// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/core/errors.h>
#include <undine/particles/setup/check_state.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

namespace undine::particles
{
  namespace
  {
    template <int dim>
    std::string
    name_of(const ParticleState<dim> &state, const std::size_t i)
    {
      std::ostringstream text;
      text << "particle " << state.identities[i] << " at (";
      for (int axis = 0; axis < dim; ++axis)
        text << (axis > 0 ? ", " : "") << state.positions[i][axis];
      text << ")";
      return text.str();
    }


    template <int dim>
    void
    check_arrays(const Setup<dim> &setup, const ParticleState<dim> &state)
    {
      const std::size_t n = state.positions.size(), n_solid = setup.reference.size();
      if (n == 0)
        throw InputError("the scene has no particles: there is neither fluid nor a body.");
      if (state.velocities.size() != n || state.pressures.size() != n || state.tags.size() != n ||
          state.identities.size() != n)
        throw InputError("the arrays of the particles differ in length.");
      if (setup.body_of.size() != n_solid || setup.clamped.size() != n_solid)
        throw InputError("the arrays of the bodies' particles differ in length.");
      if (!state.body_points.empty() && state.body_points.size() != n_solid)
        throw InputError("there are points for another number of particles of bodies.");
      std::vector<int> sorted = state.identities;
      std::sort(sorted.begin(), sorted.end());
      const auto twice = std::adjacent_find(sorted.begin(), sorted.end());
      if (twice != sorted.end())
        throw InputError("two particles have the identity " + std::to_string(*twice) + ".");
      for (std::size_t i = 0; i < n_solid + setup.n_moving; ++i)
        if (i >= n || sorted[i] != static_cast<int>(i))
          throw InputError("particle " + std::to_string(i) +
                           " of the bodies or moving walls is missing.");
    }


    /// A body of one layer of particles has no deformation across it that anything could tell.
    template <int dim>
    void
    check_layers(const Setup<dim> &setup)
    {
      const auto n_bodies = setup.bodies.size();
      for (int axis = 0; axis < dim; ++axis)
        {
          std::vector<double> lower(n_bodies, std::numeric_limits<double>::max());
          std::vector<double> upper(n_bodies, std::numeric_limits<double>::lowest());
          for (std::size_t i = 0; i < setup.reference.size(); ++i)
            {
              const int body = setup.body_of[i];
              lower[body]    = std::min(lower[body], setup.reference[i][axis]);
              upper[body]    = std::max(upper[body], setup.reference[i][axis]);
            }
          for (std::size_t body = 0; body < n_bodies; ++body)
            if (lower[body] <= upper[body] && upper[body] - lower[body] < setup.spacing / 2)
              throw InputError("body " + std::to_string(body + 1) +
                               " is one particle thick: nothing tells how it deforms across that. "
                               "Try: a smaller 'Particles/Spacing', or a thicker body.");
        }
    }


    template <int dim>
    void
    check_tag(const Setup<dim> &setup, const ParticleState<dim> &state, const std::size_t i)
    {
      const Tag  tag     = state.tags[i];
      const int  n_solid = static_cast<int>(setup.reference.size());
      const bool is_body = state.identities[i] < n_solid;
      const bool moves   = !is_body && state.identities[i] < n_solid + setup.n_moving;
      if ((tag.kind() == Kind::solid) != is_body || (tag.material() == moving_material) != moves ||
          (is_body && tag.material() != setup.body_of[state.identities[i]] + 1) ||
          (!is_body && !moves && tag.material() != 0 && !tag.is_inactive() && !tag.is_in_layers()))
        throw InputError(name_of(state, i) + " does not belong to the body that its tag says.");
    }


    template <int dim>
    void
    check_place(const Setup<dim> &setup, const ParticleState<dim> &state, const std::size_t i)
    {
      for (int axis = 0; axis < dim; ++axis)
        {
          if (!std::isfinite(state.positions[i][axis]) || !std::isfinite(state.velocities[i][axis]))
            throw InputError(name_of(state, i) + " has a place or velocity that is not a number.");
          if (state.tags[i].material() != moving_material &&
              (state.positions[i][axis] < setup.lower[axis] ||
               state.positions[i][axis] > setup.upper[axis]))
            throw InputError(name_of(state, i) +
                             " is outside the domain. Make the domain larger or move what is there "
                             "inside.");
        }
    }


    /// Particles in cells that are as long as the distance that is asked for, or longer where a
    /// large domain would have more of them than can be numbered.
    template <int dim>
    class CloseParticles
    {
    public:
      CloseParticles(const Setup<dim>         &setup,
                     const ParticleState<dim> &state,
                     const double              distance)
        : state(state)
        , grid(make_cell_grid<dim, double>(
            setup.lower, setup.upper, open, length_of_cells(setup, distance)))
        , distance(distance)
      {
        std::copy(setup.periodic, setup.periodic + dim, grid.periodic);
        const std::size_t n = state.positions.size();
        order.resize(n);
        cells.resize(n);
        for (std::size_t i = 0; i < n; ++i)
          {
            order[i] = static_cast<int>(i);
            cells[i] = grid.cell_of(state.positions[i]);
          }
        std::sort(order.begin(), order.end(), [&](const int a, const int b) {
          return cells[a] < cells[b];
        });
      }

      /// Throws if there is a pair.
      void
      check() const
      {
        for (std::size_t i = 0; i < cells.size(); ++i)
          grid.for_each_run_around(
            state.positions[i], [&](const int first, const int end, const auto &) {
              auto other = std::lower_bound(
                order.begin(), order.end(), first, [&](const int j, const int cell) {
                  return cells[j] < cell;
                });
              for (; other != order.end() && cells[*other] < end; ++other)
                if (static_cast<std::size_t>(*other) > i)
                  check(i, *other);
            });
      }

    private:
      void
      check(const std::size_t i, const std::size_t j) const
      {
        if (may_overlap(state.tags[i], state.tags[j]) || may_overlap(state.tags[j], state.tags[i]))
          return;
        const double square = norm_square(grid.difference(state.positions[i], state.positions[j]));
        if (square >= distance * distance)
          return;
        std::ostringstream text;
        text << name_of(state, i) << " and " << name_of(state, j) << " are only "
             << std::sqrt(square)
             << " m apart, less than half a spacing. Do bodies, obstacles or fluid overlap?";
        throw InputError(text.str());
      }

      /// Walls are inactive where moving ones are.
      static bool
      may_overlap(const Tag moving, const Tag wall)
      {
        return moving.material() == moving_material && !wall.is_free();
      }

      static double
      length_of_cells(const Setup<dim> &setup, const double distance)
      {
        constexpr double most   = 1e8;
        double           length = distance / 2, cells = 0;
        do
          {
            length *= 2;
            cells = 1;
            for (int axis = 0; axis < dim; ++axis)
              cells *= std::max(1., (setup.upper[axis] - setup.lower[axis]) / length);
          }
        while (cells > most && std::isfinite(cells));
        return length;
      }

      static constexpr bool open[dim] = {};

      const ParticleState<dim> &state;
      CellGrid<dim, double>     grid;
      double                    distance;
      std::vector<int>          order, cells;
    };
  } // namespace


  template <int dim>
  void
  check_state(const Setup<dim> &setup, const ParticleState<dim> &state)
  {
    if (!(setup.spacing > 0))
      throw InputError("the spacing of the particles must be positive.");
    check_arrays(setup, state);
    check_layers(setup);
    for (std::size_t i = 0; i < state.positions.size(); ++i)
      {
        check_tag(setup, state, i);
        check_place(setup, state, i);
      }
    const bool is_computed = !state.guesses.empty(); // in a splash particles come closer than that
    if (!is_computed)
      CloseParticles<dim>(setup, state, setup.spacing / 2).check();
  }


  template void
  check_state(const Setup<2> &, const ParticleState<2> &);
  template void
  check_state(const Setup<3> &, const ParticleState<3> &);
} // namespace undine::particles
