// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/core/disjoint_sets.h>
#include <undine/output/probes/particle_queries.h>
#include <undine/particle_model/plain_vector.h>
#include <undine/particles/model/lattice.h>
#include <undine/particles/setup/make_constants.h>

#include <algorithm>
#include <limits>

namespace undine
{
  template <int dim>
  std::size_t
  place_of_identity(const particles::ParticleState<dim> &state, const int identity)
  {
    const auto &identities = state.identities;
    return std::find(identities.begin(), identities.end(), identity) - identities.begin();
  }


  template <int dim>
  double
  mean_pressure(const ParticleModel<dim>            &model,
                const particles::ParticleState<dim> &state,
                const std::vector<int>              &identities)
  {
    double sum = 0;
    for (std::size_t k = 0; k < state.identities.size(); ++k)
      if (std::binary_search(identities.begin(), identities.end(), state.identities[k]))
        sum += state.pressures[k] + pressure_at_rest(model.setup(), state.positions[k]);
    return sum / identities.size();
  }


  template <int dim>
  int
  nearest_of_body(const ParticleModel<dim> &model, const int body, const dealii::Point<dim> &place)
  {
    const auto &setup  = model.setup();
    int         result = 0;
    double      least  = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < setup.reference.size(); ++k)
      if (setup.body_of[k] == body)
        {
          const double square = point_of(setup.reference[k]).distance_square(place);
          if (square < least)
            {
              least  = square;
              result = k;
            }
        }
    return result;
  }


  template <int dim>
  PointsAround<dim>::PointsAround(const ParticleDomain<dim> &domain, const double reach)
    : domain(domain)
    , reach(reach)
    , grid(reach)
  {
  }


  template <int dim>
  void
  PointsAround<dim>::add(const dealii::Point<dim> &point)
  {
    std::vector<dealii::Point<dim>> images{point};
    for (unsigned int axis = 0; axis < dim; ++axis)
      {
        if (!domain.periodic(axis))
          continue;
        const double period = domain.upper[axis] - domain.lower[axis];
        const auto   n      = images.size(); // in an edge there are images of images
        for (std::size_t k = 0; k < n; ++k)
          for (const int sign : {-1, 1})
            {
              auto image = images[k];
              image[axis] += sign * period;
              if (image[axis] > domain.lower[axis] - reach &&
                  image[axis] < domain.upper[axis] + reach)
                images.push_back(image);
            }
      }
    for (const auto &image : images)
      {
        grid.add(image);
        originals.push_back(points.size());
      }
    points.push_back(point);
  }


  template <int dim>
  std::vector<std::size_t>
  main_part_of_fluid(const ParticleDomain<dim>           &domain,
                     const particles::ParticleState<dim> &state,
                     const double                         gap)
  {
    PointsAround<dim>        points(domain, gap);
    std::vector<std::size_t> fluid; // numbers in the state
    for (std::size_t k = 0; k < state.tags.size(); ++k)
      if (state.tags[k].kind() == particles::Kind::fluid)
        {
          fluid.push_back(k);
          points.add(point_of(state.positions[k]));
        }
    DisjointSets joined(fluid.size());
    for (std::size_t k = 0; k < fluid.size(); ++k)
      points.for_each_near(k, gap, [&](const std::size_t other, double) {
        if (other < k)
          joined.join(k, other);
      });
    std::vector<std::size_t> sizes(fluid.size(), 0);
    for (std::size_t k = 0; k < fluid.size(); ++k)
      ++sizes[joined.smallest(k)];
    const std::size_t        largest = std::max_element(sizes.begin(), sizes.end()) - sizes.begin();
    std::vector<std::size_t> result;
    for (std::size_t k = 0; k < fluid.size(); ++k)
      if (joined.smallest(k) == largest)
        result.push_back(fluid[k]);
    return result;
  }


  template <int dim>
  SurfaceOffset<dim>::SurfaceOffset(const ParticleModel<dim>            &model,
                                    const particles::ParticleState<dim> &state)
    : state(state)
    , points(model.domain(), model.setup().numerics.reach * model.domain().spacing)
    , spacing(model.domain().spacing)
    , reach(model.setup().numerics.reach * spacing)
    , in_plane(particles::full_lattice(dim - 1, model.setup().numerics.reach).number_density)
    , of_all(particles::full_lattice(dim, model.setup().numerics.reach).number_density)
  {
    for (std::size_t k = 0; k < state.positions.size(); ++k)
      points.add(point_of(state.positions[k]));
  }


  template <int dim>
  double
  SurfaceOffset<dim>::operator()(const std::size_t number) const
  {
    double density = 0;
    points.for_each_near(number, reach, [&](const std::size_t other, const double distance) {
      if (other != number && !state.tags[other].is_parked())
        density += reach / std::max(distance, 0.1 * spacing) - 1;
    });
    return spacing * std::clamp((density - of_all / 2) / in_plane, -0.5, 0.5);
  }


#define UNDINE_INSTANTIATE(dim)                                                                        \
  template std::size_t place_of_identity(const particles::ParticleState<dim> &, const int);            \
  template double      mean_pressure(                                                                  \
         const ParticleModel<dim> &, const particles::ParticleState<dim> &, const std::vector<int> &); \
  template int nearest_of_body(const ParticleModel<dim> &, const int, const dealii::Point<dim> &);     \
  template class PointsAround<dim>;                                                                    \
  template std::vector<std::size_t> main_part_of_fluid(                                                \
    const ParticleDomain<dim> &, const particles::ParticleState<dim> &, const double);                 \
  template class SurfaceOffset<dim>;

  UNDINE_INSTANTIATE(2)
  UNDINE_INSTANTIATE(3)
#undef UNDINE_INSTANTIATE
} // namespace undine
