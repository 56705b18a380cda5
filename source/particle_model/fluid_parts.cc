// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/particle_model/fluid_parts.h>

#include <array>
#include <vector>

namespace undine
{
  namespace
  {
    enum class State : char
    {
      fluid,
      body,
      empty,
      done ///< a wall, or seen
    };


    /// The cubes of a domain, numbered with the first direction running fastest.
    template <int dim>
    class Cubes
    {
    public:
      explicit Cubes(const ParticleDomain<dim> &domain)
        : domain(domain)
      {
        for (unsigned int side = 0; side < 2 * dim; ++side)
          is_open[side] = domain.sides[side] == ParticleSide::open;
      }

      /// f(number) for the neighbours of a cube. Returns whether it is at a side that is open.
      template <class Function>
      bool
      for_each_neighbour(const std::size_t cube, const Function &f) const
      {
        bool        at_open = false;
        std::size_t rest = cube, stride = 1;
        for (unsigned int axis = 0; axis < dim; ++axis)
          {
            const std::size_t n = domain.cells[axis], k = rest % n;
            rest /= n;
            for (unsigned int end = 0; end < 2; ++end)
              {
                const bool        is_last = k == (end == 0 ? 0 : n - 1);
                const std::size_t first   = cube - k * stride;
                const std::size_t next    = end == 0 ? k + n - 1 : k + 1;
                if (!is_last || domain.periodic(axis))
                  f(first + next % n * stride);
                else
                  at_open = at_open || is_open[2 * axis + end];
              }
            stride *= n;
          }
        return at_open;
      }

      dealii::Point<dim>
      centre(std::size_t cube) const
      {
        dealii::Point<dim> result;
        for (unsigned int axis = 0; axis < dim; cube /= domain.cells[axis++])
          result[axis] = domain.lower[axis] + (cube % domain.cells[axis] + 0.5) * domain.spacing;
        return result;
      }

    private:
      const ParticleDomain<dim> &domain;
      std::array<bool, 2 * dim>  is_open;
    };
  } // namespace


  template <int dim>
  FluidParts<dim>::FluidParts(const ParticleDomain<dim>                             &domain,
                              const ParticleFluid<dim>                              &fluid,
                              const std::function<Cube(const dealii::Point<dim> &)> &content)
  {
    std::vector<State> states;
    std::size_t        n_placed = 0;
    domain.for_each_cell([&](const dealii::Point<dim> &place) {
      if (n_placed < fluid.places.size() && fluid.places[n_placed] == place)
        {
          ++n_placed;
          states.push_back(State::fluid);
          return;
        }
      const Cube cube = content(place);
      states.push_back(cube == Cube::wall   ? State::done
                       : cube == Cube::body ? State::body
                                            : State::empty);
    });
    const Cubes<dim>         cubes(domain);
    std::vector<std::size_t> found;
    for (std::size_t start = 0; start < states.size(); ++start)
      {
        if (states[start] != State::fluid)
          continue;
        bool is_full = true;
        found.assign(1, start);
        while (!found.empty())
          {
            const std::size_t cube = found.back();
            found.pop_back();
            is_full            = is_full && states[cube] != State::empty;
            states[cube]       = State::done;
            const bool at_open = cubes.for_each_neighbour(cube, [&](const std::size_t next) {
              if (states[next] != State::done)
                found.push_back(next);
            });
            is_full            = is_full && !at_open;
          }
        ++n;
        if (is_full && ++n_full == 1)
          in_full = cubes.centre(start);
      }
  }


  template struct FluidParts<2>;
  template struct FluidParts<3>;
} // namespace undine
