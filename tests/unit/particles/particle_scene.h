// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_tests_unit_particles_particle_scene_h
#define undine_tests_unit_particles_particle_scene_h

#include <undine/base/core/registry.h>
#include <undine/particles/engine/engine.h>

#include <algorithm>
#include <array>

#include <cmath>
#include <cstdlib>
#include <functional>
#include <memory>
#include <string>

namespace particle_tests
{
  using namespace undine;
  using namespace undine::particles;

  template <int dim>
  using Point = Vector<dim, double>;

  /// Builds scenes on a lattice of spacing l0 whose points are (k + 1/2) l0; lengths in spacings.
  template <int dim>
  struct ParticleScene
  {
    Setup<dim>         setup;
    ParticleState<dim> state;

    explicit ParticleScene(const double spacing)
    {
      setup.spacing = spacing;
      // For so few particles more than one would mostly wait for each other. A build that looks for
      // data races needs them.
      setup.numerics.threads = std::getenv("OMP_NUM_THREADS") ? 0 : 1;
    }

    /// Bodies must come before all other particles.
    int
    add_body(const BodySetup &body)
    {
      setup.bodies.push_back(body);
      return static_cast<int>(setup.bodies.size()) - 1;
    }

    void
    add(const Point<dim> &x, const Kind kind, const int material, const Point<dim> &v)
    {
      state.positions.push_back(x);
      state.velocities.push_back(v);
      state.pressures.push_back(0);
      state.tags.push_back(Tag::of(kind, material));
      state.identities.push_back(static_cast<int>(state.identities.size()));
      if (kind != Kind::solid)
        return;
      setup.reference.push_back(x);
      setup.body_of.push_back(material - 1);
      setup.clamped.push_back(0);
    }

    /// f(x) for the lattice's points between two corners [spacings].
    void
    for_each_point(const std::array<int, dim>                    &lower,
                   const std::array<int, dim>                    &upper,
                   const std::function<void(const Point<dim> &)> &f) const
    {
      std::array<int, dim> k = lower;
      while (k[dim - 1] < upper[dim - 1])
        {
          Point<dim> x;
          for (int axis = 0; axis < dim; ++axis)
            x[axis] = (k[axis] + .5) * setup.spacing;
          f(x);
          for (int axis = 0; axis < dim; ++axis)
            if (++k[axis] < upper[axis] || axis == dim - 1)
              break;
            else
              k[axis] = lower[axis];
        }
    }

    /// Walls around the box from the origin to `size` [spacings], open at the top, and the box of
    /// the particles with room above.
    void
    add_tank(const std::array<int, dim> &size, const int room_above)
    {
      const int            layers = 3;
      std::array<int, dim> lower, upper;
      for (int axis = 0; axis < dim; ++axis)
        {
          lower[axis]       = -layers;
          upper[axis]       = size[axis] + (axis == dim - 1 ? 0 : layers);
          setup.lower[axis] = -(layers + 1) * setup.spacing;
          setup.upper[axis] =
            (size[axis] + (axis == dim - 1 ? room_above : layers + 1)) * setup.spacing;
        }
      for_each_point(lower, upper, [&](const Point<dim> &x) {
        double depth = -x[dim - 1];
        for (int axis = 0; axis < dim - 1; ++axis)
          depth = std::max({depth, -x[axis], x[axis] - size[axis] * setup.spacing});
        if (depth > 0)
          add(x, depth < setup.spacing ? Kind::wall : Kind::dummy, 0, Point<dim>::zero());
      });
    }

    /// A box without walls from -size to 2 size [m].
    void
    set_free_space(const double size)
    {
      for (int axis = 0; axis < dim; ++axis)
        {
          setup.lower[axis] = -size;
          setup.upper[axis] = 2 * size;
        }
    }

    std::unique_ptr<Engine<dim>>
    engine(const Precision precision = Precision::double_precision) const
    {
      auto result = Registry<EngineFactory<dim>>::instance().make("host")->make(precision, 0);
      result->load(complete_setup(), state);
      return result;
    }

    /// With the potential of the surface of the fluid, unless it fills its domain.
    Setup<dim>
    complete_setup() const
    {
      Setup<dim> result = setup;
      if (setup.is_full)
        return result;
      const BodyForce<dim, double> force{setup.gravity, setup.attraction, setup.centre};
      bool                         is_first = true;
      for (std::size_t i = 0; i < state.tags.size(); ++i)
        if (state.tags[i].kind() == Kind::fluid)
          {
            const double potential = force.potential(state.positions[i]);
            result.top_potential = is_first ? potential : std::max(result.top_potential, potential);
            is_first             = false;
          }
      return result;
    }
  };


  template <int dim>
  Point<dim>
  along(const int axis, const double value)
  {
    auto result  = Point<dim>::zero();
    result[axis] = value;
    return result;
  }

  /// The same number in each direction.
  template <int dim>
  std::array<int, dim>
  cube(const int value)
  {
    std::array<int, dim> result;
    result.fill(value);
    return result;
  }

  /// Mean of what f(i) gives over the particles for which it is not NaN.
  template <class Function>
  double
  mean(const std::size_t n, const Function &f)
  {
    double      sum   = 0;
    std::size_t count = 0;
    for (std::size_t i = 0; i < n; ++i)
      {
        const double value = f(i);
        if (std::isnan(value))
          continue;
        sum += value;
        ++count;
      }
    return sum / count;
  }
} // namespace particle_tests

#endif
