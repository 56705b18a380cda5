// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/particles/elasticity/explicit_steps.h>
#include <undine/particles/elasticity/reference_lattice.h>
#include <undine/particles/model/lattice.h>
#include <undine/particles/setup/make_constants.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>

namespace undine::particles
{
  namespace
  {
    template <class Real>
    ElasticMaterial<Real>
    material_of(const BodySetup   &body,
                const BodyDamping &damping,
                const int          dim,
                const double       spacing)
    {
      const double E = body.youngs_modulus, nu = body.poissons_ratio;
      const double lambda = E * nu / ((1 + nu) * (1 - 2 * nu)), mu = E / (2 * (1 + nu));
      const double contact = body.contact_modulus > 0 ? body.contact_modulus : lambda + 2 * mu;
      return {static_cast<Real>(lambda),
              static_cast<Real>(mu),
              static_cast<Real>(body.density),
              static_cast<Real>(body.hourglass),
              static_cast<Real>(body.damping),
              static_cast<Real>(body.bulk_damping),
              static_cast<Real>(contact * std::pow(spacing, dim - 2)),
              static_cast<Real>(damping.stiffness),
              static_cast<Real>(damping.mass),
              body.law};
    }

    template <int dim>
    std::array<long, dim>
    cell_of(const Vector<dim, double> &x, const double size)
    {
      std::array<long, dim> cell;
      for (int axis = 0; axis < dim; ++axis)
        cell[axis] = std::lround(std::floor(x[axis] / size));
      return cell;
    }

    /// The moment sum w X X^T needs as many directions as space has; a little of its trace keeps
    /// lone rows of particles regular.
    template <int dim>
    Matrix<dim, double>
    inverse_of_moment(Matrix<dim, double> moment)
    {
      double trace = 0;
      for (int axis = 0; axis < dim; ++axis)
        trace += moment[axis][axis];
      for (int axis = 0; axis < dim; ++axis)
        moment[axis][axis] += trace > 0 ? 1e-6 * trace : 1.;
      return inverse_transpose(moment);
    }
  } // namespace


  template <int dim, class Real>
  ReferenceLattice<dim, Real>::ReferenceLattice(const Setup<dim> &setup)
    : bodies(setup.body_of)
    , clamped(setup.clamped)
    , capacity(dim * dim * 4)
    , spacing(setup.spacing)
  {
    for (const auto &x : setup.reference)
      {
        ReferencePoint<dim, Real> point;
        for (int axis = 0; axis < dim; ++axis)
          point.x[axis] = static_cast<Real>(x[axis]);
        points.push_back(point);
      }
    for (const auto &body : setup.bodies)
      materials.push_back(material_of<Real>(body, setup.body_damping, dim, spacing));
    held.assign(materials.size(), 0);
    for (std::size_t i = 0; i < bodies.size(); ++i)
      held[bodies[i]] |= clamped[i];
    members.resize(bodies.size());
    std::iota(members.begin(), members.end(), 0);
    std::stable_sort(members.begin(), members.end(), [&](const int a, const int b) {
      return bodies[a] < bodies[b];
    });
    starts.assign(materials.size() + 1, 0);
    for (const int body : bodies)
      ++starts[body + 1];
    std::partial_sum(starts.begin(), starts.end(), starts.begin());
    find_neighbours(setup.numerics.reach, setup.reference);
  }


  template <int dim, class Real>
  void
  ReferenceLattice<dim, Real>::find_neighbours(const double reach_in_spacings,
                                               const std::vector<Vector<dim, double>> &reference)
  {
    const int    n     = static_cast<int>(reference.size());
    const double reach = reach_in_spacings * spacing;
    const double full  = full_lattice(dim, reach_in_spacings).number_density;
    std::map<std::array<long, dim>, std::vector<int>> cells;
    for (int i = 0; i < n; ++i)
      cells[cell_of<dim>(reference[i], reach)].push_back(i);
    counts.assign(n, 0);
    inside.assign(n, 0);
    inverse_moments.resize(n);
    std::vector<std::vector<int>> neighbours(n);
    for (int i = 0; i < n; ++i)
      {
        auto   moment = Matrix<dim, double>::diagonal(0);
        double sum    = 0;
        for (int around = 0; around < std::lround(std::pow(3, dim)); ++around)
          {
            auto cell = cell_of<dim>(reference[i], reach);
            for (int axis = 0, rest = around; axis < dim; ++axis, rest /= 3)
              cell[axis] += rest % 3 - 1;
            const auto found = cells.find(cell);
            if (found == cells.end())
              continue;
            for (const int j : found->second)
              {
                const auto   X        = reference[j] - reference[i];
                const double distance = std::sqrt(norm_square(X));
                if (j == i || bodies[j] != bodies[i] || distance >= reach)
                  continue;
                neighbours[i].push_back(j);
                const double weight = reach / distance - 1;
                sum += weight;
                moment.add_outer_product(weight, X, X);
              }
          }
        counts[i]    = static_cast<int>(neighbours[i].size());
        capacity     = std::max(capacity, counts[i]);
        inside[i]    = sum > 0.97 * full ? 1 : 0;
        double trace = 0;
        for (int axis = 0; axis < dim; ++axis)
          trace += moment[axis][axis];
        points[i].inverse_mean = static_cast<Real>(trace > 0 ? dim / trace : 0.);
        const auto inverse     = inverse_of_moment(moment);
        for (int a = 0; a < dim; ++a)
          for (int b = 0; b < dim; ++b)
            inverse_moments[i][a][b] = static_cast<Real>(inverse[a][b]);
      }
    indices.assign(list_slot((n + 31) / 32 * 32, 0, capacity), 0);
    for (int i = 0; i < n; ++i)
      for (int k = 0; k < capacity; ++k)
        indices[list_slot(i, k, capacity)] = k < counts[i] ? neighbours[i][k] : i;
  }


  template <int dim, class Real>
  double
  ReferenceLattice<dim, Real>::rate() const
  {
    double fastest = 0, damped = 0;
    for (const auto &material : materials)
      {
        const double square =
          double(material.lambda + 2 * material.mu) / material.density + hourglass_square(material);
        fastest = std::max(fastest, std::sqrt(square));
        if (material.viscosity > 0 || material.drag > 0)
          {
            const auto rate = static_cast<Real>(square / (spacing * spacing));
            damped          = std::max(damped, double(damped_rate(material, rate, rate)));
          }
      }
    return std::max(fastest / spacing, damped);
  }


  template struct ReferenceLattice<2, float>;
  template struct ReferenceLattice<2, double>;
  template struct ReferenceLattice<3, float>;
  template struct ReferenceLattice<3, double>;
} // namespace undine::particles
