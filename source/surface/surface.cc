// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/core/errors.h>
#include <undine/base/options/point_text.h>
#include <undine/surface/simplex.h>
#include <undine/surface/surface.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

namespace undine
{
  namespace
  {
    /// One facet's use of a ridge.
    template <int dim>
    struct Use
    {
      std::array<unsigned int, dim - 1> ridge;
      unsigned int                      facet;
      unsigned int                      position; ///< in the facet

      bool
      operator<(const Use &other) const
      {
        return std::tie(ridge, facet, position) <
               std::tie(other.ridge, other.facet, other.position);
      }
    };


  } // namespace


  template <int dim>
  Surface<dim>::Surface(const unsigned int               n_nodes,
                        const std::vector<Facet>        &facets,
                        const std::vector<unsigned int> &body_of_facet,
                        const std::vector<std::string>  &body_names)
    : number_of_nodes(n_nodes)
    , all_facets(facets)
    , bodies(body_of_facet)
    , names(body_names)
  {
    AssertDimension(facets.size(), body_of_facet.size());
    for (unsigned int facet = 0; facet < facets.size(); ++facet)
      {
        auto nodes = facets[facet];
        std::sort(nodes.begin(), nodes.end());
        if (nodes.back() >= n_nodes ||
            std::adjacent_find(nodes.begin(), nodes.end()) != nodes.end())
          throw InputError(fmt::format("Body '{}': facet {} of its boundary joins nodes {}; they "
                                       "must be different and lower than {}.",
                                       names[bodies[facet]],
                                       facet,
                                       fmt::join(facets[facet], ", "),
                                       n_nodes));
      }
    find_ridges();
  }


  template <int dim>
  void
  Surface<dim>::find_ridges()
  {
    std::vector<Use<dim>> uses;
    for (unsigned int facet = 0; facet < all_facets.size(); ++facet)
      for (unsigned int k = 0; k < dim; ++k)
        uses.push_back({ridge(all_facets[facet], k), facet, k});
    std::sort(uses.begin(), uses.end());
    ridges_of_facet.resize(all_facets.size());
    for (const auto &use : uses)
      {
        if (all_ridges.empty() || all_ridges.back() != use.ridge)
          all_ridges.push_back(use.ridge);
        ridges_of_facet[use.facet][use.position] = all_ridges.size() - 1;
      }
  }


  template <int dim>
  void
  check_closed(const Surface<dim> &surface, const std::vector<dealii::Point<dim>> &positions)
  {
    struct Count
    {
      unsigned int forward = 0, backward = 0, body = 0;
    };
    std::vector<Count> counts(surface.ridges().size());
    const auto         fail = [&](const unsigned int facet, const unsigned int k, const auto &why) {
      throw InputError(
        fmt::format("The boundary of body '{}' {} at {}. It must be closed, and every edge must "
                            "join two facets: give parts that touch nodes of their own.",
                    surface.body_names()[surface.body(facet)],
                    why,
                    text_of(positions[ridge(surface.facets()[facet], k)[0]])));
    };
    for (unsigned int facet = 0; facet < surface.facets().size(); ++facet)
      for (unsigned int k = 0; k < dim; ++k)
        {
          auto      &count   = counts[surface.ridges(facet)[k]];
          const bool forward = runs_forward(surface.facets()[facet], k);
          if (count.forward + count.backward > 0 && count.body != surface.body(facet))
            fail(facet, k, "shares nodes with another body");
          count.body = surface.body(facet);
          if (++(forward ? count.forward : count.backward) > 1)
            fail(facet, k, "branches or changes its orientation");
        }
    for (unsigned int facet = 0; facet < surface.facets().size(); ++facet)
      for (unsigned int k = 0; k < dim; ++k)
        {
          const auto &count = counts[surface.ridges(facet)[k]];
          if (count.forward + count.backward != 2)
            fail(facet, k, "is open");
        }
  }


  template <int dim>
  dealii::Tensor<1, dim>
  area_vector(const Surface<dim>                    &surface,
              const unsigned int                     facet,
              const std::vector<dealii::Point<dim>> &positions)
  {
    std::array<dealii::Point<dim>, dim> nodes;
    for (unsigned int k = 0; k < dim; ++k)
      nodes[k] = positions[surface.facets()[facet][k]];
    return area_vector(nodes);
  }


  template <int dim>
  dealii::Tensor<1, dim>
  mean_area_vector(const Surface<dim>                    &surface,
                   const unsigned int                     facet,
                   const std::vector<dealii::Point<dim>> &before,
                   const std::vector<dealii::Point<dim>> &after)
  {
    // Simpson's rule.
    std::array<dealii::Point<dim>, dim> middle;
    for (unsigned int k = 0; k < dim; ++k)
      {
        const unsigned int node = surface.facets()[facet][k];
        middle[k]               = before[node] + .5 * (after[node] - before[node]);
      }
    return (area_vector(surface, facet, before) + 4. * area_vector(middle) +
            area_vector(surface, facet, after)) /
           6.;
  }


  template <int dim>
  std::vector<double>
  body_volumes(const Surface<dim> &surface, const std::vector<dealii::Point<dim>> &positions)
  {
    // Relative to a point of each body: a small body far from the origin keeps its digits.
    std::vector<double>                     volumes(surface.body_names().size(), 0.);
    std::vector<const dealii::Point<dim> *> origins(volumes.size(), nullptr);
    for (unsigned int facet = 0; facet < surface.facets().size(); ++facet)
      {
        const unsigned int body  = surface.body(facet);
        const auto        &point = positions[surface.facets()[facet][0]];
        if (origins[body] == nullptr)
          origins[body] = &point;
        volumes[body] += (point - *origins[body]) * area_vector(surface, facet, positions) / dim;
      }
    return volumes;
  }


  template <int dim>
  std::string
  positions_complaint(const Surface<dim> &surface, const std::vector<dealii::Point<dim>> &positions)
  {
    for (unsigned int facet = 0; facet < surface.facets().size(); ++facet)
      for (const unsigned int node : surface.facets()[facet])
        if (!std::isfinite(positions[node].norm_square()))
          return fmt::format("Body '{}': a position of its boundary is not a number.",
                             surface.body_names()[surface.body(facet)]);
    const auto        volumes = body_volumes(surface, positions);
    std::vector<bool> present(volumes.size(), false);
    for (unsigned int facet = 0; facet < surface.facets().size(); ++facet)
      present[surface.body(facet)] = true;
    for (unsigned int body = 0; body < volumes.size(); ++body)
      if (present[body] && !(volumes[body] > 0))
        return fmt::format("Body '{}' is inside out: the volume that its boundary encloses is "
                           "{:.3g} m^{}.",
                           surface.body_names()[body],
                           volumes[body],
                           dim);
    return "";
  }


  template <int dim>
  void
  check_positions(const Surface<dim> &surface, const std::vector<dealii::Point<dim>> &positions)
  {
    const auto complaint = positions_complaint(surface, positions);
    if (!complaint.empty())
      throw SolveError(complaint + " Try a smaller time step. If so at the start, the cells of the "
                                   "body are numbered the wrong way round.");
  }


  // clang-format off
#define INSTANTIATE(dim)                                                                           \
  template class Surface<dim>;                                                                     \
  template void check_closed(const Surface<dim> &, const std::vector<dealii::Point<dim>> &);       \
  template dealii::Tensor<1, dim> area_vector(const Surface<dim> &,                                \
                                              const unsigned int,                                  \
                                              const std::vector<dealii::Point<dim>> &);            \
  template dealii::Tensor<1, dim> mean_area_vector(const Surface<dim> &,                           \
                                                   const unsigned int,                             \
                                                   const std::vector<dealii::Point<dim>> &,        \
                                                   const std::vector<dealii::Point<dim>> &);       \
  template std::vector<double> body_volumes(const Surface<dim> &,                                  \
                                            const std::vector<dealii::Point<dim>> &);              \
  template std::string positions_complaint(const Surface<dim> &,                                   \
                                           const std::vector<dealii::Point<dim>> &);               \
  template void check_positions(const Surface<dim> &, const std::vector<dealii::Point<dim>> &);
  // clang-format on
  INSTANTIATE(2)
  INSTANTIATE(3)
#undef INSTANTIATE
} // namespace undine
