// SPDX-License-Identifier: LGPL-2.1-or-later
#include "dam_break.h"

#include <algorithm>
#include <cmath>

namespace undine::particles
{
  namespace
  {
    constexpr int layers = 3;             ///< of the walls
    constexpr int length = 4, height = 3; ///< of the tank [a]
  }                                       // namespace


  DamBreak::DamBreak(const int n, const Sphere sphere)
    : n(n)
    , l0(width / n)
    , has_sphere(sphere == Sphere::with)
    , centre{{2 * width, width / 2, width / 4 + l0 / 2}}
  {
    setup.spacing         = l0;
    setup.lower           = {{-layers * l0, 0, -layers * l0}};
    setup.upper           = {{length * width + layers * l0, width, 4 * width}};
    setup.periodic[1]     = true;
    setup.gravity         = {{0, 0, -9.81}};
    setup.fluid_viscosity = 1e-6;
    setup.depth           = 2 * width;
    add_sphere();
    for (int k = -layers; k < height * n; ++k)
      for (int j = 0; j < n; ++j)
        for (int i = -layers; i < length * n + layers; ++i)
          {
            const int               depth = depth_in_walls(i, k);
            const Vector<3, double> x{{(i + 0.5) * l0, (j + 0.5) * l0, (k + 0.5) * l0}};
            if (depth > 0)
              add(x, Tag::of(depth == 1 ? Kind::wall : Kind::dummy, 0));
            else if (i < n && k < 2 * n && !is_in_sphere(x))
              add(x, Tag::of(Kind::fluid, 0));
          }
  }


  double
  DamBreak::front(const ParticleState<3> &state) const
  {
    std::vector<double> x;
    for (std::size_t i = 0; i < state.tags.size(); ++i)
      if (state.tags[i].kind() == Kind::fluid)
        x.push_back(state.positions[i][0]);
    const auto last = x.end() - std::max<std::ptrdiff_t>(1, x.size() / 1000);
    std::nth_element(x.begin(), last, x.end());
    return (*last + l0 / 2) / width;
  }


  int
  DamBreak::count_outside(const ParticleState<3> &state) const
  {
    int count = 0;
    for (std::size_t i = 0; i < state.tags.size(); ++i)
      {
        const auto &x = state.positions[i];
        if (state.tags[i].is_free() &&
            !(x[0] > -l0 / 2 && x[0] < length * width + l0 / 2 && x[2] > -l0 / 2))
          ++count;
      }
    return count;
  }


  void
  DamBreak::add(const Vector<3, double> &x, const Tag tag)
  {
    start.identities.push_back(static_cast<int>(start.identities.size()));
    start.positions.push_back(x);
    start.velocities.push_back(Vector<3, double>::zero());
    start.pressures.push_back(0);
    start.tags.push_back(tag);
  }


  void
  DamBreak::add_sphere()
  {
    if (!has_sphere)
      return;
    BodySetup body;
    body.density        = 500;
    body.youngs_modulus = 1e5;
    body.poissons_ratio = 0.49;
    setup.bodies.push_back(body);
    for (int k = 0; k < n; ++k)
      for (int j = 0; j < n; ++j)
        for (int i = n; i < 3 * n; ++i)
          {
            const Vector<3, double> x{{(i + 0.5) * l0, (j + 0.5) * l0, (k + 0.5) * l0}};
            if (!is_in_sphere(x))
              continue;
            add(x, Tag::of(Kind::solid, 1));
            setup.reference.push_back(x);
            setup.body_of.push_back(0);
            setup.clamped.push_back(0);
          }
  }


  /// 0: inside the tank.
  int
  DamBreak::depth_in_walls(const int i, const int k) const
  {
    return std::max({-k, -i, i - (length * n - 1), 0});
  }


  bool
  DamBreak::is_in_sphere(const Vector<3, double> &x) const
  {
    return has_sphere && norm_square(x - centre) < width * width / 16;
  }
} // namespace undine::particles
