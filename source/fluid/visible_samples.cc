// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/fluid/interpolation.h>
#include <undine/fluid/visible_samples.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <limits>

namespace undine
{
  namespace
  {
    /// Share that a visible point has even where its multilinear weight is zero, if those with more
    /// weight are hidden.
    constexpr double least_weight = 1e-3;

    /// Share of the way from a point to the centroid of its part: far less than is smoothed
    /// otherwise, far more than rounding.
    constexpr double side_share = 1e-10;


    /// The point that a boundary point continues; others themselves.
    template <int dim>
    GridIndex<dim>
    inside(const Lattice<dim> &lattice, GridIndex<dim> index)
    {
      for (unsigned int d = 0; d < dim; ++d)
        if (!lattice.row(d).periodic())
          index[d] = std::clamp(index[d], 0, lattice.row(d).size() - 1);
      return index;
    }


    /// The place of a point of the lattice; faces are in the cells above them.
    template <int dim>
    typename BodyVicinity<dim>::Place
    located(const Lattice<dim> &lattice, const GridIndex<dim> &index)
    {
      auto cell = inside(lattice, index);
      if (const auto axis = lattice.normal_axis(); axis < dim && !lattice.row(axis).periodic())
        cell[axis] = std::min(cell[axis], lattice.row(axis).size() - 2);
      return {lattice.point(index), cell};
    }
  } // namespace


  template <int dim>
  VisibleSamples<dim>::VisibleSamples(const Field<dim>        &field_,
                                      const GridIndex<dim>    &width,
                                      const Obstruction<dim>  &obstruction_,
                                      const BodyVicinity<dim> &vicinity_)
    : field(field_)
    , obstruction(obstruction_)
    , vicinity(vicinity_)
  {
    gather_sights(width);
    gather_parts(width);
  }


  template <int dim>
  void
  VisibleSamples<dim>::gather_sights(const GridIndex<dim> &width)
  {
    using Kind          = typename LatticeParts<dim>::Kind;
    const auto &lattice = field.lattice();
    const auto &stored  = field.stored();
    sights.assign(stored.size(), Sight::value);
    if (const auto *divided = field.divided())
      {
        Field<dim> kinds(field.shared_lattice());
        for_each(kinds.owned(), [&](const GridIndex<dim> &index) {
          kinds(index) = static_cast<int>(divided->kind(index));
        });
        kinds.exchange(width);
        for_each(stored, [&](const GridIndex<dim> &index) {
          const auto kind = static_cast<Kind>(static_cast<int>(kinds(inside(lattice, index))));
          sights[stored.position(index)] = kind == Kind::whole    ? Sight::value
                                           : kind == Kind::closed ? Sight::nothing
                                                                  : Sight::parts;
        });
      }
    obstruction.for_each_swept(lattice, stored, [&](const GridIndex<dim> &index) {
      auto &sight = sights[stored.position(index)];
      if (sight == Sight::value)
        sight = Sight::nothing;
    });
  }


  template <int dim>
  void
  VisibleSamples<dim>::gather_parts(const GridIndex<dim> &width)
  {
    const auto         &lattice = field.lattice();
    const IndexBox<dim> whole{{}, lattice.shape()};
    const auto         *divided = field.divided();
    const unsigned int  n_ranks = lattice.blocks().n_ranks();
    using Named                 = std::array<double, dim + 3>; // position, place, value, measure
    std::map<unsigned int, std::vector<Named>> outgoing;
    for (unsigned int rank = 0; divided && rank < n_ranks; ++rank)
      {
        const auto box = lattice.with_ghosts(rank, width);
        for (std::size_t k = 0; k < field.parts().size(); ++k)
          if (const auto &part = divided->all()[k]; divided->owns(k))
            {
              // Images of the rank's box may reach the part across a periodic side.
              bool wanted = true;
              for (unsigned int d = 0; d < dim; ++d)
                {
                  const int period = lattice.row(d).periodic() ? lattice.row(d).size() : 0;
                  bool      inside = false;
                  for (const int shift : {-period, 0, period})
                    inside = inside || (part.index[d] + shift >= box.lower[d] &&
                                        part.index[d] + shift < box.upper[d]);
                  wanted = wanted && inside;
                }
              if (!wanted)
                continue;
              Named named{};
              named[0] = whole.position(part.index);
              for (unsigned int d = 0; d < dim; ++d)
                named[1 + d] = part.place[d];
              named[dim + 1] = field.parts()[k];
              named[dim + 2] = part.measure;
              outgoing[rank].push_back(named);
            }
      }
    const auto received =
      dealii::Utilities::MPI::some_to_some(lattice.blocks().communicator(), outgoing);
    for (const auto &message : received)
      for (const auto &named : message.second)
        {
          Sample sample;
          for (unsigned int d = 0; d < dim; ++d)
            sample.place[d] = named[1 + d];
          sample.value   = named[dim + 1];
          sample.measure = named[dim + 2];
          if (!obstruction.swept(sample.place))
            parts[static_cast<std::size_t>(named[0])].push_back(sample);
        }
  }


  template <int dim>
  std::optional<double>
  VisibleSamples<dim>::value_of(const GridIndex<dim> &index,
                                const Eye            &eye,
                                const bool            all_visible) const
  {
    const auto &lattice = field.lattice();
    const auto  sight   = sights[field.stored().position(index)];
    if (sight == Sight::nothing)
      return {};
    if (sight == Sight::value)
      {
        const bool hidden = !all_visible && vicinity.is_hidden(eye.place, located(lattice, index));
        return hidden ? std::nullopt : std::optional<double>(field(index));
      }
    const auto point = inside(lattice, index), own = lattice.wrapped(point);
    const auto found = parts.find(IndexBox<dim>{{}, lattice.shape()}.position(own));
    if (found == parts.end())
      return {};
    const bool             is_own = eye.own != nullptr && point == *eye.own;
    dealii::Tensor<1, dim> image; // where what is known of the point appears here
    if (!(point == own))
      image = lattice.point(point) - lattice.point(own);
    return value_of_parts(found->second, image, eye, is_own);
  }


  template <int dim>
  std::optional<double>
  VisibleSamples<dim>::value_of_parts(const std::vector<Sample>    &samples,
                                      const dealii::Tensor<1, dim> &image,
                                      const Eye                    &eye,
                                      const bool                    only_nearest) const
  {
    double sum = 0, total = 0, nearest = std::numeric_limits<double>::infinity();
    for (const auto &sample : samples)
      if (const dealii::Point<dim> place = sample.place + image;
          !vicinity.is_hidden(eye.place, vicinity.place(place)))
        {
          const double distance = place.distance(eye.place.point);
          if (only_nearest && distance >= nearest)
            continue;
          if (only_nearest)
            sum = total = 0;
          nearest = distance;
          sum += sample.measure * sample.value;
          total += sample.measure;
        }
    return total > 0 ? std::optional<double>(sum / total) : std::nullopt;
  }


  template <int dim>
  std::optional<double>
  VisibleSamples<dim>::at(const dealii::Point<dim> &place) const
  {
    return multilinear(place, {vicinity.place(place), nullptr});
  }


  template <int dim>
  std::optional<double>
  VisibleSamples<dim>::along(const GridIndex<dim>     &index,
                             const dealii::Point<dim> &place,
                             const dealii::Point<dim> &foot) const
  {
    const auto &lattice = field.lattice();
    const auto  point   = lattice.point(index);
    const Eye   eye{vicinity.place(foot), place == point ? nullptr : &index};
    if (foot == place)
      if (const auto own = value_of(index, eye, false))
        return own;
    // A trace of the way to the centroid says on which side of the point the fluid is.
    const dealii::Point<dim> start = point + (foot - place) + side_share * (place - point);
    if (!is_clear_for_cubics(start, foot))
      return multilinear(start, eye);
    const bool is_scalar = lattice.normal_axis() >= dim;
    return interpolate_cubic(field, start, is_scalar);
  }


  template <int dim>
  bool
  VisibleSamples<dim>::is_clear_for_cubics(const dealii::Point<dim> &place,
                                           const dealii::Point<dim> &eye) const
  {
    GridIndex<dim> lower, upper;
    for (unsigned int d = 0; d < dim; ++d)
      {
        const auto stencil = field.lattice().row(d).stencil(place[d]);
        lower[d]           = stencil.first;
        upper[d]           = stencil.first + static_cast<int>(stencil.n_points) - 1;
      }
    return is_visible_box(lower, upper, eye);
  }


  template <int dim>
  bool
  VisibleSamples<dim>::is_visible_box(const GridIndex<dim>     &lower,
                                      const GridIndex<dim>     &upper,
                                      const dealii::Point<dim> &eye) const
  {
    const auto below = located(field.lattice(), lower), above = located(field.lattice(), upper);
    bool       result = vicinity.is_clear(below.cell, above.cell);
    for (unsigned int d = 0; d < dim; ++d)
      result = result && eye[d] >= below.point[d] && eye[d] <= above.point[d];
    return result;
  }


  template <int dim>
  std::optional<double>
  VisibleSamples<dim>::multilinear(const dealii::Point<dim> &place, const Eye &eye) const
  {
    GridIndex<dim>          lower;
    std::array<double, dim> weights;
    for (unsigned int d = 0; d < dim; ++d)
      {
        const auto bracket = field.lattice().row(d).locate(place[d]);
        lower[d]           = bracket.lower;
        weights[d]         = bracket.weight;
      }
    auto upper = lower;
    for (unsigned int d = 0; d < dim; ++d)
      ++upper[d];
    const bool all_visible = is_visible_box(lower, upper, eye.place.point);
    double     sum = 0, total = 0, raised_sum = 0, raised_total = 0;
    for (unsigned int corner = 0; corner < (1u << dim); ++corner)
      {
        auto   index  = lower;
        double weight = 1;
        for (unsigned int d = 0; d < dim; ++d)
          {
            const int higher = (corner >> d) & 1;
            index[d] += higher;
            weight *= higher == 1 ? weights[d] : 1 - weights[d];
          }
        if (const auto value = value_of(index, eye, all_visible))
          {
            sum += weight * *value;
            total += weight;
            raised_sum += (weight + least_weight) * *value;
            raised_total += weight + least_weight;
          }
      }
    if (total > least_weight)
      return sum / total;
    return raised_total > 0 ? std::optional<double>(raised_sum / raised_total) : std::nullopt;
  }


  template class VisibleSamples<2>;
  template class VisibleSamples<3>;
} // namespace undine
