// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/contact/barrier.h>
#include <undine/contact/contact_potential.h>

#include <deal.II/base/symmetric_tensor.h>

#include <algorithm>

namespace undine
{
  namespace
  {
    template <int dim>
    using Vectors = std::array<dealii::Tensor<1, dim>, dim + 1>;

    template <int dim>
    using Positions = typename ContactSurfaces<dim>::Positions;


    template <int dim>
    dealii::Tensor<2, dim>
    unit()
    {
      return dealii::Tensor<2, dim>(dealii::unit_symmetric_tensor<dim>());
    }


    /// m(c) = c/e (2 - c/e) of c = |u x v|^2 < e, the squared area between two edges u = x1 - x0
    /// and v = x3 - x2, and its derivatives: nothing where they are parallel, so that their nearest
    /// points may jump there. Without edges, and for c >= e, m = 1 (S17).
    template <int dim>
    struct Crossing
    {
      Crossing(const ContactTerm<dim> &term, const Positions<dim> &places)
      {
        if (term.crossing == 0)
          return;
        u               = places[term.nodes[1]] - places[term.nodes[0]];
        v               = places[term.nodes[term.n - 1]] - places[term.nodes[term.n - 2]];
        const double uv = u * v;
        const double c  = std::max(u.norm_square() * v.norm_square() - uv * uv, 0.);
        const double e  = term.crossing;
        if (c >= e)
          return;
        value           = c / e * (2 - c / e);
        slope           = 2 / e * (1 - c / e);
        curvature       = -2 / (e * e);
        const auto by_u = 2 * (v.norm_square() * u - uv * v);
        const auto by_v = 2 * (u.norm_square() * v - uv * u);
        for (unsigned int i = 0; i < term.n; ++i)
          gradient[i] = sign(i) * (i < 2 ? by_u : by_v);
      }

      static double
      sign(const unsigned int i)
      {
        return i % 2 == 0 ? -1 : 1;
      }

      /// d^2c / dx_i dx_j [m^2].
      dealii::Tensor<2, dim>
      second(const unsigned int i, const unsigned int j) const
      {
        const double factor = 2 * sign(i) * sign(j);
        const auto   along  = [&](const auto &edge) {
          return factor * (edge.norm_square() * unit<dim>() - outer_product(edge, edge));
        };
        const auto across = [&](const auto &a, const auto &b) {
          return factor * (2. * outer_product(a, b) - outer_product(b, a) - (u * v) * unit<dim>());
        };
        if (i < 2)
          return j < 2 ? along(v) : across(u, v);
        return j < 2 ? across(v, u) : along(u);
      }

      dealii::Tensor<1, dim> u, v;
      double                 value     = 1;
      double                 slope     = 0; ///< dm/dc [1/m^4]
      double                 curvature = 0; ///< [1/m^8]
      Vectors<dim>           gradient;      ///< dc/dx_i [m^3]
    };


    /// slope d^2 distance + curvature (d distance) (d distance)^T.
    template <int dim>
    NodeMatrices<dim>
    by_distance(const ContactTerm<dim> &term,
                const Positions<dim>   &places,
                const double            slope,
                const double            curvature)
    {
      NodeMatrices<dim> result;
      const auto        normal  = outer_product(term.direction, term.direction);
      const double      turning = term.wall == term.no_wall ? slope / term.distance : 0;

      // The nearest points move along their simplices.
      std::array<dealii::Point<dim>, dim> vectors; // after the origin: difference vectors
      std::array<std::array<dealii::Tensor<1, dim>, dim + 1>, dim>
        mixed; // [difference vector][node]
      for (unsigned int a = 0; a < term.n_edge_vectors; ++a)
        {
          const auto &edge = term.edge_vectors[a];
          vectors[a + 1]   = dealii::Point<dim>(
            edge.sign * (places[term.nodes[edge.to]] - places[term.nodes[edge.from]]));
          for (unsigned int i = 0; i < term.n; ++i)
            {
              const int change = i == edge.to ? edge.sign : i == edge.from ? -edge.sign : 0;
              mixed[a][i]      = (change * term.distance) * term.direction +
                            term.shares[i] * dealii::Tensor<1, dim>(vectors[a + 1]);
            }
        }
      const auto inverse = inverse_of_products<dim>(term.n_edge_vectors + 1, vectors);
      for (unsigned int i = 0; i < term.n; ++i)
        for (unsigned int j = 0; j < term.n; ++j)
          {
            const double shares = term.shares[i] * term.shares[j];
            result[i][j]        = (shares * turning) * unit<dim>();
            result[i][j] += (shares * (curvature - turning)) * normal;
            for (unsigned int a = 0; a < term.n_edge_vectors; ++a)
              for (unsigned int b = 0; b < term.n_edge_vectors; ++b)
                result[i][j] -= (turning * inverse[a][b]) * outer_product(mixed[a][i], mixed[b][j]);
          }
      return result;
    }
  } // namespace


  template <int dim>
  double
  ContactPotential<dim>::energy(const Term &term, const Positions &places) const
  {
    return stiffness * term.area * term.activation_distance * Crossing<dim>(term, places).value *
           barrier(term.distance / term.activation_distance);
  }


  template <int dim>
  Vectors<dim>
  ContactPotential<dim>::forces(const Term &term, const Positions &places) const
  {
    const Crossing<dim> crossing(term, places);
    const double        s       = term.distance / term.activation_distance;
    const double        size    = stiffness * term.area;
    const double        slope   = size * crossing.value * barrier_slope(s);
    const double        turning = size * term.activation_distance * crossing.slope * barrier(s);
    Vectors<dim>        result;
    for (unsigned int i = 0; i < term.n; ++i)
      result[i] = -(slope * term.shares[i]) * term.direction - turning * crossing.gradient[i];
    return result;
  }


  template <int dim>
  NodeMatrices<dim>
  ContactPotential<dim>::second_derivatives(const Term &term, const Positions &places) const
  {
    const Crossing<dim> crossing(term, places);
    const double        s    = term.distance / term.activation_distance;
    const double        size = stiffness * term.area;
    auto                result =
      by_distance<dim>(term,
                       places,
                       size * crossing.value * barrier_slope(s),
                       size * crossing.value / term.activation_distance * barrier_curvature(s));
    if (crossing.slope == 0)
      return result;
    const double energy = size * term.activation_distance * barrier(s);
    const double mixed  = size * barrier_slope(s) * crossing.slope;
    for (unsigned int i = 0; i < term.n; ++i)
      for (unsigned int j = 0; j < term.n; ++j)
        {
          const auto &c = crossing.gradient;
          result[i][j] += (mixed * term.shares[j]) * outer_product(c[i], term.direction);
          result[i][j] += (mixed * term.shares[i]) * outer_product(term.direction, c[j]);
          result[i][j] += (energy * crossing.curvature) * outer_product(c[i], c[j]);
          result[i][j] += (energy * crossing.slope) * crossing.second(i, j);
        }
    return result;
  }


  template <int dim>
  NodeMatrices<dim>
  ContactPotential<dim>::convex_part(const Term &term, const Positions &places) const
  {
    const double s    = term.distance / term.activation_distance;
    const double size = stiffness * term.area * Crossing<dim>(term, places).value;
    return by_distance<dim>(
      term, places, 0, size / term.activation_distance * barrier_curvature(s));
  }


  template class ContactPotential<2>;
  template class ContactPotential<3>;
} // namespace undine
