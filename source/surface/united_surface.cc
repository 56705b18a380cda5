// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/surface/divided_facet.h>
#include <undine/surface/simplex.h>
#include <undine/surface/surface_crossings.h>
#include <undine/surface/surface_distance.h>
#include <undine/surface/united_surface.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <random>

namespace undine
{
  namespace
  {
    /// Of a new node on an edge [m].
    template <int dim>
    dealii::Point<dim>
    place_of(const typename SurfaceCrossings<dim>::NewNode &node,
             const std::vector<dealii::Point<dim>>         &positions)
    {
      const auto &from = positions[node.edge[0]], &to = positions[node.edge[1]];
      return from + node.part * (to - from);
    }


    /// Positions that differ by less than `distance` [m], at random but always the same.
    template <int dim>
    std::vector<dealii::Point<dim>>
    disturbed(std::vector<dealii::Point<dim>> positions, const double distance, const unsigned seed)
    {
      std::mt19937 engine(seed);
      for (auto &position : positions)
        for (unsigned int d = 0; d < dim; ++d)
          position[d] += distance * (engine() / 4294967296. - 0.5);
      return positions;
    }


    template <int dim>
    class Union
    {
    public:
      using Facet = typename Surface<dim>::Facet;
      using Ridge = typename Surface<dim>::Ridge;

      Union(const Surface<dim>                    &surface,
            const std::vector<dealii::Point<dim>> &old_positions,
            const double                           rounding,
            const std::vector<PairOfSurfaces>     &pairs,
            const SurfaceCrossings<dim>           &crossings)
        : surface(surface)
        , rounding(rounding)
        , crossings(crossings)
        , pairs(pairs)
        , positions(old_positions)
      {
        for (const auto &node : crossings.new_nodes)
          positions.push_back(place_of<dim>(node, old_positions));
        for (unsigned int facet = 0; facet < surface.facets().size() && !has_failed; ++facet)
          divide(facet);
      }

      std::optional<UnitedSurface<dim>>
      united()
      {
        if (has_failed)
          return std::nullopt;
        std::vector<Facet>          kept;
        std::vector<unsigned int>   bodies;
        std::vector<FacetPart<dim>> kept_parts;
        const auto                  covered = is_covered();
        if (has_failed)
          return std::nullopt;
        for (std::size_t k = 0; k < facets.size(); ++k)
          if (!covered[k])
            {
              kept.push_back(facets[k]);
              bodies.push_back(surface.body(parts[k].facet));
              kept_parts.push_back(parts[k]);
            }
        const Surface<dim> result(positions.size(), kept, bodies, surface.body_names());
        if (!closes(result))
          return std::nullopt;
        return UnitedSurface<dim>{result, positions, kept_parts};
      }

    private:
      void
      add(const unsigned int facet, const Facet &nodes, const FacetPart<dim> &part)
      {
        facets.push_back(nodes);
        parts.push_back(part);
        is_cut.push_back(crossings.in_facets.count(facet) > 0);
      }

      void
      divide(const unsigned int facet)
      {
        const auto               &nodes = surface.facets()[facet];
        FacetWithPoints<dim>      whole;
        std::vector<unsigned int> numbers(nodes.begin(), nodes.end());
        for (unsigned int k = 0; k < dim; ++k)
          {
            whole.points.push_back({});
            whole.points.back()[k] = 1;
          }
        const auto found = crossings.in_facets.find(facet);
        if (found == crossings.in_facets.end())
          {
            FacetPart<dim> part{facet, {}};
            std::copy(whole.points.begin(), whole.points.end(), part.corners.begin());
            add(facet, nodes, part);
            return;
          }
        for (const auto &[node, weights] : found->second.nodes)
          {
            numbers.push_back(node);
            whole.points.push_back(weights);
          }
        for (const auto &line : found->second.lines)
          {
            Ridge local;
            for (unsigned int k = 0; k < line.size(); ++k)
              local[k] = std::find(numbers.begin(), numbers.end(), line[k]) - numbers.begin();
            whole.lines.push_back(local);
            all_lines.insert(line);
          }
        const auto pieces = divided(whole);
        has_failed        = pieces.empty();
        for (const auto &piece : pieces)
          {
            Facet          corners;
            FacetPart<dim> part{facet, {}};
            for (unsigned int k = 0; k < dim; ++k)
              {
                corners[k]      = numbers[piece[k]];
                part.corners[k] = whole.points[piece[k]];
              }
            add(facet, corners, part);
          }
      }

      /// Whether each facet lies in another body of a pair. What is joined other than along lines
      /// where surfaces cross is alike.
      std::vector<bool>
      is_covered()
      {
        std::vector<std::size_t> patch(facets.size());
        std::iota(patch.begin(), patch.end(), std::size_t(0));
        const auto first_of = [&](std::size_t k) {
          while (patch[k] != k)
            k = patch[k] = patch[patch[k]];
          return k;
        };
        std::map<std::pair<unsigned int, Ridge>, std::size_t> facet_at;
        for (std::size_t f = 0; f < facets.size(); ++f)
          for (unsigned int k = 0; k < dim; ++k)
            if (const auto joint = ridge(facets[f], k); all_lines.count(joint) == 0)
              {
                const auto known =
                  facet_at.insert({{surface.body(parts[f].facet), joint}, f}).first->second;
                patch[first_of(f)] = first_of(known);
              }
        // The largest cut facet of each patch speaks for it: others are as they were.
        std::map<std::size_t, std::size_t> speakers;
        for (std::size_t f = 0; f < facets.size(); ++f)
          if (is_cut[f])
            {
              const auto speaker = speakers.insert({first_of(f), f}).first;
              if (size(f) > size(speaker->second))
                speaker->second = f;
            }
        std::vector<bool>           result(facets.size(), false);
        std::map<std::size_t, bool> answers;
        for (const auto &[first, speaker] : speakers)
          answers[first] = lies_in_another(speaker);
        for (std::size_t f = 0; f < facets.size(); ++f)
          if (const auto answer = answers.find(first_of(f)); answer != answers.end())
            result[f] = answer->second;
        return result;
      }

      std::array<dealii::Point<dim>, dim>
      corners(const std::size_t facet) const
      {
        std::array<dealii::Point<dim>, dim> result;
        for (unsigned int k = 0; k < dim; ++k)
          result[k] = positions[facets[facet][k]];
        return result;
      }

      double
      size(const std::size_t facet) const
      {
        return area_vector(corners(facet)).norm();
      }

      bool
      lies_in_another(const std::size_t facet)
      {
        dealii::Point<dim> middle;
        for (const auto &corner : corners(facet))
          middle += corner / double(dim);
        const unsigned int body = surface.body(parts[facet].facet);
        for (const auto &[a, b] : pairs)
          if (body == a || body == b)
            {
              auto &distance = distances[body == a ? b : a];
              if (!distance)
                distance = std::make_unique<const SurfaceDistance<dim>>(
                  one_surface(surface, body == a ? b : a), positions_of_old());
              const double height = distance->nearest(middle).distance;
              has_failed          = has_failed || std::abs(height) <= rounding;
              if (height < 0)
                return true;
            }
        return false;
      }

      std::vector<dealii::Point<dim>>
      positions_of_old() const
      {
        return {positions.begin(), positions.begin() + surface.n_nodes()};
      }

      /// Does every ridge join two facets that agree on which side the solid is?
      static bool
      closes(const Surface<dim> &result)
      {
        std::vector<std::array<unsigned int, 2>> uses(result.ridges().size());
        for (unsigned int facet = 0; facet < result.facets().size(); ++facet)
          for (unsigned int k = 0; k < dim; ++k)
            ++uses[result.ridges(facet)[k]][runs_forward(result.facets()[facet], k) ? 1 : 0];
        return std::all_of(
          uses.begin(), uses.end(), [](const auto &use) { return use[0] == 1 && use[1] == 1; });
      }

      const Surface<dim>                &surface;
      const double                       rounding; ///< of distances [m]
      const SurfaceCrossings<dim>       &crossings;
      const std::vector<PairOfSurfaces> &pairs;
      std::vector<dealii::Point<dim>>    positions; ///< old nodes, then new ones
      std::vector<Facet>                 facets;    ///< all parts of all facets
      std::vector<FacetPart<dim>>        parts;
      std::vector<bool>                  is_cut; ///< is it a part of a facet that another crosses?
      std::set<Ridge>                    all_lines;
      bool                               has_failed = false;
      std::map<unsigned int, std::unique_ptr<const SurfaceDistance<dim>>> distances; ///< by body
    };
  } // namespace


  template <int dim>
  std::optional<UnitedSurface<dim>>
  united_surface(const Surface<dim>                    &surface,
                 const std::vector<dealii::Point<dim>> &positions,
                 const std::vector<PairOfSurfaces>     &pairs)
  {
    if (pairs.empty())
      return std::nullopt;
    // Where rounding decides, other places do: the nearer ones first, but they must differ by much
    // more than what rounding leaves of nearly parallel facets.
    constexpr unsigned n_trials    = 5;
    constexpr double   uncertainty = 1e-12;
    const double       rounding    = rounding_of_places(surface, positions);
    double             distance    = rounding;
    auto               judged_at   = positions;
    for (unsigned int trial = 0; trial < n_trials; ++trial)
      {
        if (trial > 0)
          judged_at = disturbed(positions, distance *= 10, trial);
        const auto crossings =
          find_crossings(surface, judged_at, pairs, trial == 0 ? uncertainty : 0.);
        if (crossings.in_facets.empty())
          return std::nullopt;
        if (!crossings.are_sure)
          continue;
        if (auto result =
              Union<dim>(surface, judged_at, 1e-3 * rounding, pairs, crossings).united())
          {
            std::copy(positions.begin(), positions.end(), result->positions.begin());
            for (std::size_t k = 0; k < crossings.new_nodes.size(); ++k)
              result->positions[positions.size() + k] =
                place_of<dim>(crossings.new_nodes[k], positions);
            return result;
          }
      }
    return std::nullopt;
  }


#define UNDINE_INSTANTIATE(dim)                              \
  template struct FacetPart<dim>;                            \
  template struct UnitedSurface<dim>;                        \
  template std::optional<UnitedSurface<dim>> united_surface( \
    const Surface<dim> &,                                    \
    const std::vector<dealii::Point<dim>> &,                 \
    const std::vector<PairOfSurfaces> &);

  UNDINE_INSTANTIATE(2)
  UNDINE_INSTANTIATE(3)
#undef UNDINE_INSTANTIATE
} // namespace undine
